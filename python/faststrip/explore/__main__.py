"""``python -m faststrip.explore``."""

import sys

from .server import main

if __name__ == "__main__":
    sys.exit(main())
