"""Direct position analysis: all assembly modes, and tracking of one."""
