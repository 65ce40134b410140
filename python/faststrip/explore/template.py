"""The frame of the page: how it is laid out on screen and paper."""

TEMPLATE = """
{% block preamble %}
<style>
  html, body { margin: 0; background: white; font-family: sans-serif; font-size: 12px; }
  body { padding: 4px 6px; }
  @page { size: A4 landscape; margin: 8mm; }
  @media print { body { zoom: 0.8; padding: 0; print-color-adjust: exact;
                        -webkit-print-color-adjust: exact; } }
</style>
{% endblock %}
"""
