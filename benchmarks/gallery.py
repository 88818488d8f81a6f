"""Run the commands of docs/gallery.md, and put the figures that they draw, made smaller, beside those of the paper.

python benchmarks/gallery.py docs/figures
"""

import argparse
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image

PAGE = Path(__file__).resolve().parents[1] / "docs" / "gallery.md"
WIDTH, MOST_BYTES = 480, 300_000  # width in pixels


def commands() -> list[list[str]]:
    """Return the words of the commands in the first block of code of the page."""
    return [shlex.split(line) for line in PAGE.read_text(encoding="utf-8").split("```")[1].strip().splitlines()]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=Path, help="folder of the pictures")
    out = parser.parse_args().out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        for words in commands():
            subprocess.run([sys.executable, "-m", *words], cwd=folder, check=True)
        for drawn in sorted(Path(folder).glob("*.png")):
            with Image.open(drawn) as picture:
                small = picture.convert("RGB").resize((WIDTH, round(WIDTH * picture.height / picture.width)))
            path = out / f"gallery_{drawn.name}"
            small.save(path, optimize=True)
            if path.stat().st_size > MOST_BYTES:
                small.quantize(256).save(path, optimize=True)
            print(path)


if __name__ == "__main__":
    main()
