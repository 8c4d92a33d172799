"""Front of ``python -m signimit render``."""

import sys

from signimit.__main__ import main

if __name__ == "__main__":
    main(["render", *sys.argv[1:]])
