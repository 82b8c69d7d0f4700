# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a command in a folder with the library preloaded, and reads what it leaves there."""

import json
import os
import re
import shutil
import signal
import sqlite3
import subprocess
import time
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path

# Keys of summary.json that depend on the clock.
OF_THE_CLOCK = {"wall_seconds", "step_seconds", "particle_steps_per_second"}
LONGEST = 60  # s of processor time, after which a command counts as hanging
STUCK = 20 * LONGEST  # s of wall time, which is long because the machine may be busy
# Error of each kind of call; the second, if given, is used if the call fails from then on.
ERRORS = {"open": ("EACCES", "EMFILE"), "read": ("EIO", "EIO"), "write": ("ENOSPC", "ENOSPC"), "fsync": ("EIO", "EIO"),
          "rename": ("EACCES", "ENOSPC"), "unlink": ("EACCES", "EROFS"), "mkdir": ("ENOSPC", "EACCES"), "truncate": ("EIO", "EPERM"),
          "mmap": ("ENOMEM", "ENOMEM"), "close": ("EIO", "ENOSPC"), "opendir": ("EACCES", "EMFILE"), "readdir": ("EIO", "EIO"),
          "stat": ("EACCES", "EIO"), "flock": ("ENOLCK", "ENOLCK"), "memory": ("ENOMEM", "ENOMEM"),
          "thread": ("EAGAIN", "EAGAIN"), "fork": ("EAGAIN", "EAGAIN")}
CAUSES = {"EACCES": "Permission denied", "EMFILE": "Too many open files", "EIO": "Input/output error", "ENOSPC": "No space left on device",
          "EROFS": "Read-only file system", "EPERM": "Operation not permitted", "ENOMEM": "memory", "ENOLCK": "No locks available",
          "EAGAIN": "Resource temporarily unavailable"}


OF_A_PATH = ("EACCES", "EPERM", "EROFS")  # errors that the user can correct have exit code 2; all others are errors of the system, with exit code 4


@dataclass
class Call:
    """A logged call: its kind, its number among the calls of this kind, and its path."""
    kind: str
    number: int
    path: str


@dataclass
class Run:
    words: str
    code: int | None  # negative: signal that ended it; None: it hung
    out: str
    err: str
    calls: list = field(default_factory=list)

    @property
    def hung(self):
        return self.code is None


def processor_seconds(group):
    """Processor time of a process group, including ended children."""
    ticks = 0
    for file in Path("/proc").glob("[0-9]*/stat"):
        try:
            values = file.read_text(errors="replace").rpartition(")")[2].split()
        except OSError:  # the process has ended
            continue
        if int(values[2]) == group:
            ticks += sum(int(value) for value in values[11:15])
    return ticks / os.sysconf("SC_CLK_TCK")


def end_of(process):
    """Exit code and both streams of a group's leader. If it hangs, its group is killed, and the exit code is None."""
    begun = time.monotonic()
    while True:
        try:
            out, err = process.communicate(timeout=LONGEST / 4)
            return process.returncode, out, err
        except subprocess.TimeoutExpired:
            if processor_seconds(process.pid) > LONGEST or time.monotonic() - begun > STUCK:
                os.killpg(process.pid, signal.SIGKILL)
                return None, *process.communicate()


class Program:
    def __init__(self, program, library):
        self.program, self.library = Path(program).resolve(), Path(library).resolve()

    def run(self, words, place, before=(), **faults):
        """Runs a command in place/work. faults: values of the variables CRACKLE_FAULT_...; before: words put before the program."""
        folder, log = place / "work", place / "log"
        log.unlink(missing_ok=True)
        environment = {key: value for key, value in os.environ.items() if not key.startswith("CRACKLE_")}
        environment |= {"NO_COLOR": "1", "OMP_WAIT_POLICY": "passive"}
        if faults:
            environment |= {"LD_PRELOAD": str(self.library), "CRACKLE_FAULT_FOLDER": str(folder), "CRACKLE_FAULT_LOG": str(log)}
            environment |= {f"CRACKLE_FAULT_{key.upper()}": str(value) for key, value in faults.items() if value is not True}
        process = subprocess.Popen([*before, str(self.program), *words.split()], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, process_group=0)
        code, out, err = end_of(process)
        calls = []
        if log.exists():
            for line in log.read_text(errors="replace").splitlines():
                kind, number, path = line.split(" ", 2)
                calls.append(Call(kind, int(number), os.path.relpath(path, folder) if path.startswith("/") else path))
        return Run(words, code, out.decode(errors="replace"), err.decode(errors="replace"), calls)

    def calls(self, words, place):
        """All calls of an undisturbed command that can be made to fail."""
        return self.run(words, place, list=True)


def table_of(ledger):
    """Results in a campaign's ledger, without values that depend on the clock; for other files, their bytes."""
    try:
        with closing(sqlite3.connect(f"file:{ledger}?mode=ro", uri=True)) as opened:
            found = opened.execute("SELECT * FROM results")
            names = [column[0] for column in found.description]
            rows = [dict(zip(names, row)) for row in found]
    except sqlite3.Error:
        return ledger.read_bytes()
    return json.dumps([{name: row[name] for name in sorted(row) if name != "processor_seconds"} for row in rows]).encode()


def contents(folder):
    """{name: bytes} of all files in a folder; names of folders end with a slash. Values that depend on the clock are left out, and ledgers
    are replaced by their tables."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if path.name.endswith(".crackle_tmp"):
            continue  # left by a stopped command; the next one removes it
        if path.is_dir():
            found[name + "/"] = b""
            continue
        if path.name.endswith(("-wal", "-shm", "-journal")):  # auxiliary files of SQLite
            continue
        data = table_of(path) if path.suffix == ".sqlite" else path.read_bytes()
        if path.name.startswith("calibration."):
            data = re.sub(rb'\d+ s of (?:a processor|processor time)|"processor_seconds": [-+.e\d]+', b"", data)
        if path.name == "summary.json":
            try:
                whole = json.loads(data)
                data = json.dumps({key: value for key, value in whole.items() if key not in OF_THE_CLOCK}).encode()
            except (ValueError, AttributeError):
                pass
        found[name] = data
    return found


def put(folder, files):
    """Writes files as returned by contents()."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for name, data in files.items():
        path = folder / name
        if name.endswith("/"):
            path.mkdir(parents=True, exist_ok=True)
        else:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)


def below(files, name):
    """Part of contents(): one folder or file."""
    return {key: data for key, data in files.items() if key == name or key.startswith(name + "/")}


def differences(got, expected, most=3):
    """The differences as text, or an empty text."""
    found = [f"no {name}" for name in expected if name not in got]
    found += [f"{name} is new" for name in got if name not in expected]
    found += [f"{name} differs" for name in got if name in expected and got[name] != expected[name]]
    return ", ".join(found[:most]) + (f" and {len(found) - most} more" if len(found) > most else "")
