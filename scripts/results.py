"""Front of ``python -m signimit results``."""

import sys

from signimit.__main__ import main

if __name__ == "__main__":
    main(["results", *sys.argv[1:]])
