"""Commands that make a run folder, or add to one."""
