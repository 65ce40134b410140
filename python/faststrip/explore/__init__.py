"""The interactive explorer: one wheel on one rail, or a wheelset, solved while sliders move.

``faststrip-explore`` or ``python -m faststrip.explore`` serves it on this machine only. It needs
Bokeh: ``pip install faststrip[explore]``.
"""
