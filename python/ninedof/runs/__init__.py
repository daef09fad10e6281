"""Run folders, records and design files."""
