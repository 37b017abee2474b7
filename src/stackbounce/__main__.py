"""``python -m stackbounce`` is the command line, too."""

import sys

from stackbounce.cli import main

if __name__ == "__main__":
    sys.exit(main())
