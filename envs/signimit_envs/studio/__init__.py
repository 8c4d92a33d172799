"""The studio: draw signs and movements in a browser, and watch the simulated arm answer.

Needs the extra ``studio``. `store` keeps sessions as events on the disk, `open_session` learns from them, `arm`
simulates and renders the live table, `page` says what is shown of both, `web` serves it, and `studio.Studio` holds all
that lives as long as the server. `demo` plays a session by itself, `load` measures a studio from outside.
"""
