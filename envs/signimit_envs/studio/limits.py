"""Limits of what the studio takes from a browser."""

from __future__ import annotations

from dataclasses import dataclass

from signimit_envs.arm.scene import OBJECT_COUNTS


@dataclass(frozen=True, kw_only=True)
class Limits:
    """Upper limits of sizes, counts and rates.

    Attributes:
        body: Bytes of a request.
        upload: Bytes of an imported file.
        text: Bytes of it if it is text, which takes fifty times the memory to read.
        unpacked: Bytes of what is in it.
        held: Bytes of all requests that are under way.
        patience: Time within which a request must have come, s.
        journal: Bytes of a session.
        sentence: Characters of a sentence that has in it what was sent.
        reach: Distance of objects and hands from the table's middle along an axis, m.
        message: Bytes of a message on the socket.
        points: Points of a stroke.
        lifts: Strokes of one sign, between which the pen was lifted.
        seconds: Length of a stroke, s.
        coordinate: Size of a coordinate of a sign, any unit.
        demonstrations: Demonstrations in a session.
        answers: Answers in a session.
        events: Edits of a session, those that were undone counted too.
        sessions: Sessions in a folder.
        viewers: Pages that watch the arm.
        messages: Socket messages of a page, 1/s.
        requests: Requests, 1/s.
        burst: Requests at once.
        title: Characters of a session's title.
        objects: Objects in a scene.
        drawn: Demonstrations in a figure.
        waiting: Figures, films and imports that wait to be made.
        connections: Connections at once; of more, the one goes that was waited for longest.
    """

    body: int = 4 * 2**20
    upload: int = 32 * 2**20
    text: int = 8 * 2**20
    unpacked: int = 64 * 2**20
    held: int = 64 * 2**20
    patience: float = 60.0
    journal: int = 64 * 2**20
    sentence: int = 500
    reach: float = 2.0
    message: int = 1024
    points: int = 5000
    lifts: int = 50
    seconds: float = 600.0
    coordinate: float = 1e6
    demonstrations: int = 100
    answers: int = 500
    events: int = 5000
    sessions: int = 500
    viewers: int = 8
    messages: int = 120
    requests: int = 40
    burst: int = 120
    title: int = 80
    objects: int = OBJECT_COUNTS[-1]
    drawn: int = 60
    waiting: int = 8
    connections: int = 100


LIMITS = Limits()
