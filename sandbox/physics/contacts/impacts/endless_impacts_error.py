"""The error for bodies that collide endlessly at one instant."""

from sandbox.model.translatable_message import Message

OFTEN = Message(
    "bodies in contact collide too often to be followed: their masses differ too much, or they"
    " are wedged in; reduce their 'restitution'",
)


class EndlessImpacts(Exception):  # noqa: N818 (it is converted into an error)
    """Bodies collide at one instant more often than can be followed.

    `body` is the index of one of the bodies; the reason may name it, as {body}.
    """

    def __init__(self, body: int, reason: Message = OFTEN, **values: object) -> None:
        self.body, self._reason, self._values = body, reason, values
        super().__init__(reason)

    def message_for(self, body: str) -> Message:
        """Return the reason, with the name of the body."""
        return self._reason.filled(body=f"'{body}'", **self._values)
