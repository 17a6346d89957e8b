"""Serve the page on loopback for a test, and stop by itself after an hour: serve.py [FILE]."""

import os
import sys
import threading
from pathlib import Path

from antinode.app.server import run_app

LONGEST = 3600.0


def main():
    """Run the server on a free port, which its first line on stderr names."""
    watchdog = threading.Timer(LONGEST, os._exit, [0])
    watchdog.daemon = True
    watchdog.start()
    run_app(Path(sys.argv[1]) if len(sys.argv) > 1 else None, port=0)


if __name__ == "__main__":
    main()
