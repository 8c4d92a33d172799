"""The studio: draw signs and movements with a mouse, and watch the simulated arm answer."""

from __future__ import annotations

import webbrowser
from pathlib import Path

from signimit.exceptions import InvalidInputError
from signimit_envs.studio.web.serving import LOCAL, StudioPlan, serve_studio


def main(
    folder: Path = Path("out/studio"),
    port: int = 0,
    host: str = LOCAL,
    i_know: bool = False,
    open: bool = True,
    demo: bool = False,
    seed: int = 0,
) -> None:
    """Open the studio in a browser: teach with your own signs, ask, look, and keep it all.

    Args:
        folder: Where sessions are kept, as they are made.
        port: Port to listen on; 0 takes any that is free.
        host: Address to listen on. Another than this machine's own needs --i-know: everybody in the network who has
            the whole address can use the studio, and it is not encrypted.
        i_know: You know what --host does.
        open: Whether to open the page in a browser; its address is printed anyway.
        demo: Play a whole session by itself.
        seed: Decides what happens in new sessions.
    """
    if host != LOCAL and not i_know:
        raise InvalidInputError("--host", f"{LOCAL}, or --i-know beside it: others can then reach the studio", host)

    def announce(address: str) -> None:
        print(f"The studio is at {address}\nInterrupt (Ctrl-C) to close it.", flush=True)
        if open:
            webbrowser.open(address)

    serve_studio(StudioPlan(folder=folder, host=host, port=port, seed=seed, demo=demo), announce)
