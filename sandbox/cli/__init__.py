"""The command line: `commands` declares the commands, and modules beside it do their work.

A command's work is imported when it runs, so that no command waits for what it does not need.
"""
