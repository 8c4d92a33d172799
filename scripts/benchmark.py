"""Front of ``python -m signimit benchmark``."""

import sys

from signimit.__main__ import main

if __name__ == "__main__":
    main(["benchmark", *sys.argv[1:]])
