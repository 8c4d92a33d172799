"""The studio: draw signs and movements in a browser, and watch the simulated arm answer.

Needs the extra ``studio``. One module a part: `events` and `history` say what a session is, `shelf` keeps
it, `belief` and `wishes` say what the imitator makes of it, `live_arm` moves, `camera` looks, `web` serves.
"""
