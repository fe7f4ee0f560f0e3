"""Shorthand for authors: repeated members, and groups that are placed several times.

It is expanded before a level is read, so that no other code deals with it; `WrittenOut` keeps where
everything was typed, for messages. Only the expansion has a meaning: a level with shorthand is the
same level as its expansion.
"""

from sandbox.model.shorthand.expansion import WrittenOut as WrittenOut
from sandbox.model.shorthand.expansion import write_out as write_out
