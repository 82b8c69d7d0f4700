#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests that the library makes exactly the chosen calls fail, using calls of Python itself; also tests the disc model."""

import os
import signal
import subprocess
import sys
import tempfile
import textwrap
import unittest
from pathlib import Path
from unittest import mock

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
from disc import Disc, Operation, read_trace  # noqa: E402
from program import ERRORS, Program  # noqa: E402

LIBRARY = os.environ["INJECTED_FAULTS"]

# One call of each kind on a file or folder in `work`.
CALLS = {
    "open": "os.open('new', os.O_CREAT | os.O_WRONLY)",
    "read": "os.read(file, 10)",
    "write": "os.write(file, b'abc')",
    "fsync": "os.fsync(file)",
    "rename": "os.rename('old', 'other')",
    "unlink": "os.unlink('old')",
    "mkdir": "os.mkdir('folder')",
    "truncate": "os.ftruncate(file, 1)",
    "mmap": "mmap.mmap(file, 3)",
    "close": "os.close(file)",
    "opendir": "os.listdir('.')",
    "readdir": "os.listdir('.')",
    "stat": "os.stat('old')",
    "flock": "fcntl.flock(file, fcntl.LOCK_EX)",
    "memory": "bytearray(1 << 20)",
    "thread": "threading.Thread(target=int).start()",
    "fork": "os.fork() == 0 and os._exit(0)",
}


class Library(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.work = Path(self.scratch.name).resolve() / "work"
        self.work.mkdir()
        (self.work / "old").write_text("old")

    def tearDown(self):
        self.scratch.cleanup()

    def run_python(self, text, **faults):
        environment = os.environ | {"LD_PRELOAD": LIBRARY, "CRACKLE_FAULT_FOLDER": str(self.work), "CRACKLE_FAULT_LOG": str(self.work.parent / "log")}
        environment |= {f"CRACKLE_FAULT_{key.upper()}": str(value) for key, value in faults.items()}
        return subprocess.run(["/usr/bin/python3", "-I", "-c", textwrap.dedent(text)], cwd=self.work, env=environment, capture_output=True, text=True)

    def log(self):
        file = self.work.parent / "log"
        return file.read_text().splitlines() if file.exists() else []

    BEGIN = "import os, mmap, fcntl, threading\nfile = os.open('old', os.O_RDWR)\n"

    def test_each_kind_fails_with_its_error(self):
        for kind, text in CALLS.items():
            with self.subTest(kind):
                (self.work / "old").write_text("old")
                (self.work.parent / "log").unlink(missing_ok=True)
                self.run_python(f"{self.BEGIN}import errno\n{text}")
                at = sum(line.split()[0] == kind for line in self.log())  # the last call, since Python makes calls of its own
                (self.work / "old").write_text("old")
                (self.work / "new").unlink(missing_ok=True)
                (self.work / "other").unlink(missing_ok=True)
                if (self.work / "folder").exists():
                    (self.work / "folder").rmdir()
                (self.work.parent / "log").unlink(missing_ok=True)
                error = ERRORS[kind][0]
                raised = {"memory": "MemoryError", "thread": "RuntimeError"}.get(kind, "OSError")
                done = self.run_python(f"{self.BEGIN}import errno\ntry: {text}\nexcept {raised} as e:\n    print(getattr(e, 'errno', errno.{error}) == errno.{error})",
                                       call=kind, at=at, errno=error)
                self.assertEqual(done.stdout, "True\n", done.stderr)
                self.assertEqual([line.split()[:2] for line in self.log()], [[kind, str(at)]])

    def test_without_a_kind_all_are_listed_and_none_fails(self):
        for kind, text in CALLS.items():
            with self.subTest(kind):
                (self.work / "old").write_text("old")
                (self.work.parent / "log").unlink(missing_ok=True)
                done = self.run_python(self.BEGIN + text)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn(kind, [line.split()[0] for line in self.log()])

    def written(self, mode):
        self.run_python("import os\nfile = os.open('out', os.O_CREAT | os.O_WRONLY)\nfor k in b'abcde':\n    try: os.write(file, bytes([k]))\n    except OSError: pass\n",
                        call="write", at=3, mode=mode, errno="ENOSPC")
        return (self.work / "out").read_text()

    def test_the_third_write_fails_once(self):
        self.assertEqual(self.written("once"), "abde")
        self.assertEqual(self.log(), [f"write 3 {self.work}/out"])

    def test_all_from_the_third_write_on_fail(self):
        self.assertEqual(self.written("on"), "ab")
        self.assertEqual(len(self.log()), 3)

    def test_other_folders_are_left_alone(self):
        done = self.run_python("open('../beside', 'w').write('x'); print(open('../beside').read())", call="open", at=1, mode="on")
        self.assertEqual(done.stdout, "x\n", done.stderr)
        self.assertEqual(self.log(), [])

    def test_a_name_relative_to_a_folder_is_found(self):
        done = self.run_python("import os\nos.mkdir('a')\nf = os.open('a', os.O_RDONLY)\ntry: os.unlink('../old', dir_fd=f)\nexcept OSError: print('failed')",
                               call="unlink", at=1)
        self.assertEqual(done.stdout, "failed\n", done.stderr)
        self.assertEqual(self.log(), [f"unlink 1 {self.work}/old"])

    def test_a_signal_comes_at_its_write(self):
        for name in ("KILL", "TERM", "HUP"):
            done = self.run_python(f"import os\nfile = os.open('{name}', os.O_CREAT | os.O_WRONLY)\nfor k in b'abc': os.write(file, bytes([k]))", call="write", at=3, signal=name)
            self.assertEqual(done.returncode, -getattr(signal, f"SIG{name}"))
            self.assertEqual((self.work / name).read_text(), "ab")

    def test_a_trace_makes_the_folder_again(self):
        before = {"old": b"old"}
        done = self.run_python("""
            import os
            os.mkdir('a')
            f = os.open('a/b.tmp', os.O_CREAT | os.O_WRONLY)
            os.write(f, b'one'); os.writev(f, [b'two', b'three']); os.fsync(f); os.close(f)
            os.rename('a/b.tmp', 'a/b')
            f = os.open('old', os.O_WRONLY | os.O_APPEND)
            os.write(f, b'er')
            os.truncate('old', 4)
            os.unlink('a/b')
            os.rename('old', 'a/c')
            """, trace=self.work.parent / "trace")
        self.assertEqual(done.returncode, 0, done.stderr)
        disc = Disc(before)
        for operation in read_trace(self.work.parent / "trace", self.work):
            disc.do(operation)
        self.assertEqual(disc.after_loss("kept", "kept"), {"a/": b"", "a/c": b"olde"})
        self.assertEqual(disc.after_loss("lost", "lost"), {"old": b"old"})


class Discs(unittest.TestCase):
    def test_what_was_not_brought_to_the_disc_may_be_lost(self):
        disc = Disc({"kept": b"old"})
        for kind, path, data in (("create", "kept.tmp", b""), ("write", "kept.tmp", b"new"), ("rename", "kept.tmp", b"kept")):
            disc.do(Operation(kind, path, 0, data))
        self.assertEqual(disc.after_loss("lost", "kept"), {"kept": b""})
        self.assertEqual(disc.after_loss("kept", "lost"), {"kept": b"old"})
        disc.do(Operation("fsync", "kept", 0, b""))
        self.assertEqual(disc.after_loss("lost", "kept"), {"kept": b"new"})
        disc.do(Operation("fsync", ".", 0, b""))
        self.assertEqual(disc.after_loss("lost", "lost"), {"kept": b"new"})


class Hangs(unittest.TestCase):
    def run_shell(self, text):
        with tempfile.TemporaryDirectory() as folder, mock.patch("program.LONGEST", 0.5):
            (Path(folder) / "work").mkdir()
            (Path(folder) / "work/script").write_text(text)
            return Program("/bin/sh", LIBRARY).run("script", Path(folder))

    def test_what_waits_for_a_processor_or_a_disc_does_not_hang(self):
        done = self.run_shell("sleep 1.5; echo there")
        self.assertEqual((done.code, done.out), (0, "there\n"))

    def test_what_works_without_an_end_hangs_and_so_does_what_it_began(self):
        for text in ("while :; do :; done", "(while :; do :; done) & wait"):
            self.assertTrue(self.run_shell(text).hung, text)


if __name__ == "__main__":
    unittest.main()
