"""The refusal of bodies that collide again and again in one moment."""

from sandbox.model.message import Message

OFTEN = Message(
    "bodies that touch collide too often to be followed: their masses are too far apart, or they"
    " are wedged in; let their 'restitution' be less",
)


class EndlessImpacts(Exception):  # noqa: N818 (whoever knows the names and the time tells it)
    """Bodies that collide in one moment more often than can be followed.

    Attributes
    ----------
    body
        The index of one of them; the reason may name it, as {body}.
    """

    def __init__(self, body: int, reason: Message = OFTEN, **values: object) -> None:
        self.body, self._reason, self._values = body, reason, values
        super().__init__(reason)

    def told(self, body: str) -> Message:
        """Return what is wrong, with the name of the body."""
        return self._reason.filled(body=f"'{body}'", **self._values)
