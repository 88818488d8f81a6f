"""The command ``pointchart``, and ``python -m pointchart``."""

import sys


def main() -> None:
    """Run the command line; Ctrl-C ends it quietly, from the first import on."""
    try:
        from .cli import main as run

        run()
    except KeyboardInterrupt:
        sys.exit(130)


if __name__ == "__main__":
    main()
