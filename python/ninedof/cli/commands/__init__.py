"""The commands, one file each: the function of the name of the module is the command.

A module also holds PLACE, its place in the list of commands, and EXAMPLES, what --help shows below the options. `app`
registers every module of this folder; what commands share lies beside the folder.
"""
