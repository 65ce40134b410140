"""What the plotting commands of faststrip share: CSV reading, results, style and panels.

Everything drawn comes from CSV files; nothing of the contact mechanics is computed here.
"""
