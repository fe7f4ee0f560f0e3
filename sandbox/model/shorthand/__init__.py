"""What authors may write shorter: members that repeat, and groups that are placed several times.

It is written out before a level is read, so that nothing else knows of it; `WrittenOut` keeps
where everything was typed, for messages. Only what is written out has a meaning: a level with
shorthand is the same level as the one typed out at length.
"""

from sandbox.model.shorthand.expansion import WrittenOut as WrittenOut
from sandbox.model.shorthand.expansion import write_out as write_out
