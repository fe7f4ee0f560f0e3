"""The command line: `commands` says what there is, and each command's work is a module beside it.

That work is imported when its command runs, so that no command waits for what it does not need.
"""
