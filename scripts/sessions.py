"""Front of ``python -m signimit sessions``."""

import sys

from signimit.__main__ import main

if __name__ == "__main__":
    main(["sessions", *sys.argv[1:]])
