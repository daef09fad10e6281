"""Run folders and design files: `folder` writes and reads every run folder, `design_file` reads one design."""
