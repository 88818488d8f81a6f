import signal
import subprocess
import sys

import pytest

from pointchart import FormatError
from pointchart.io.output import remove_temporaries, replacing
from pointchart.runs.interruptible import interruptibly

# A call that computes for ten minutes without a look at signals, with a file half written.
DEAF = """
import ctypes, os, signal, sys, threading, time
from pointchart import cli
from pointchart.__main__ import main
from pointchart.io import replacing
signal.signal(signal.SIGINT, signal.default_int_handler)
signal.signal(signal.SIGHUP, signal.SIG_DFL)
def run():
    with replacing("mesh.ply") as temporary:
        temporary.write_text("half")
        threading.Timer(0.1, lambda: os.kill(os.getpid(), int(sys.argv[1]))).start()
        ctypes.CDLL(None).sleep(600)
cli.main = run
main()
"""


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP], ids=lambda number: number.name)
def test_signals_to_end_are_heard_while_a_kernel_computes_and_leave_nothing_behind(tmp_path, number):
    command = [sys.executable, "-c", DEAF, str(int(number))]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stdout, done.stderr) == (128 + number, "", "")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("reason", [SystemExit(3), ValueError("no"), KeyboardInterrupt()])
def test_what_the_run_raises_is_raised(reason):
    def fail():
        raise reason

    with pytest.raises(type(reason)) as raised:
        interruptibly(fail)
    assert raised.value is reason


def test_temporary_files_of_a_block_can_be_removed_from_outside(tmp_path):
    def write():
        with replacing(tmp_path / "a.txt") as temporary:
            temporary.write_text("half")
            remove_temporaries()

    with pytest.raises(FormatError, match="cannot be written"):
        write()
    assert list(tmp_path.iterdir()) == []
