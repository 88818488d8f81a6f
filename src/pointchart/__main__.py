"""The command ``pointchart``, and ``python -m pointchart``."""

from .runs.interruptible import ending_quietly, interruptibly


def main() -> None:
    """Run the command line; Ctrl-C, or another signal to end, ends it quietly from the first import on."""
    with ending_quietly():
        from .cli import main as run

        interruptibly(run)


if __name__ == "__main__":
    main()
