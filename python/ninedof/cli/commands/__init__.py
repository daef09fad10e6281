"""The commands, one file each: the function with the name of the module is the command.

A module also holds EXAMPLES, a line each, which --help shows below the options. `app` registers every module of the
folders here. Code shared by several commands is in the folder above.
"""
