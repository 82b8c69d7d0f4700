# SPDX-License-Identifier: GPL-3.0-or-later
"""A command of the program in a folder, with the library in front of it; and what it leaves there."""

import json
import os
import shutil
import signal
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

# Of summary.json: what depends on the clock.
OF_THE_CLOCK = {"wall_seconds", "step_seconds", "particle_steps_per_second"}
LONGEST = 60  # s: what takes longer hangs
# What each kind of call says where it fails; of two the second where it fails from then on.
ERRORS = {"open": ("EACCES", "EMFILE"), "read": ("EIO", "EIO"), "write": ("ENOSPC", "ENOSPC"), "fsync": ("EIO", "EIO"),
          "rename": ("EACCES", "ENOSPC"), "unlink": ("EACCES", "EROFS"), "mkdir": ("ENOSPC", "EACCES"), "truncate": ("EIO", "EPERM"),
          "mmap": ("ENOMEM", "ENOMEM"), "close": ("EIO", "ENOSPC"), "opendir": ("EACCES", "EMFILE"), "readdir": ("EIO", "EIO"),
          "stat": ("EACCES", "EIO"), "flock": ("ENOLCK", "ENOLCK"), "memory": ("ENOMEM", "ENOMEM"),
          "thread": ("EAGAIN", "EAGAIN")}
CAUSES = {"EACCES": "Permission denied", "EMFILE": "Too many open files", "EIO": "Input/output error", "ENOSPC": "No space left on device",
          "EROFS": "Read-only file system", "EPERM": "Operation not permitted", "ENOMEM": "memory", "ENOLCK": "No locks available",
          "EAGAIN": "Resource temporarily unavailable"}


@dataclass
class Call:
    """One on the log: its kind, its number among those of its kind, what it was for."""
    kind: str
    number: int
    path: str


@dataclass
class Run:
    words: str
    code: int | None  # negative: the signal that ended it; None: it hung
    out: str
    err: str
    calls: list = field(default_factory=list)

    @property
    def hung(self):
        return self.code is None


class Program:
    def __init__(self, program, library):
        self.program, self.library = Path(program).resolve(), Path(library).resolve()

    def run(self, words, place, before=(), **faults):
        """In place/work; faults: values of CRACKLE_FAULT_..., by the ends of their names. before: words put before the program."""
        folder, log = place / "work", place / "log"
        log.unlink(missing_ok=True)
        environment = {key: value for key, value in os.environ.items() if not key.startswith("CRACKLE_")}
        environment |= {"NO_COLOR": "1", "OMP_WAIT_POLICY": "passive"}
        if faults:
            environment |= {"LD_PRELOAD": str(self.library), "CRACKLE_FAULT_FOLDER": str(folder), "CRACKLE_FAULT_LOG": str(log)}
            environment |= {f"CRACKLE_FAULT_{key.upper()}": str(value) for key, value in faults.items() if value is not True}
        process = subprocess.Popen([*before, str(self.program), *words.split()], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        try:
            out, err = process.communicate(timeout=LONGEST)
            code = process.returncode
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            out, err = process.communicate()
            code = None
        calls = []
        if log.exists():
            for line in log.read_text(errors="replace").splitlines():
                kind, number, path = line.split(" ", 2)
                calls.append(Call(kind, int(number), os.path.relpath(path, folder) if path.startswith("/") else path))
        return Run(words, code, out.decode(errors="replace"), err.decode(errors="replace"), calls)

    def calls(self, words, place):
        """All that can fail of an undisturbed command."""
        return self.run(words, place, list=True)


def contents(folder):
    """{name: bytes} of all files in a folder, and its folders with a stroke behind them; of summary.json what does not depend on the clock."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if path.is_dir():
            found[name + "/"] = b""
            continue
        data = path.read_bytes()
        if path.name == "summary.json":
            try:
                whole = json.loads(data)
                data = json.dumps({key: value for key, value in whole.items() if key not in OF_THE_CLOCK}).encode()
            except (ValueError, AttributeError):
                pass
        found[name] = data
    return found


def put(folder, files):
    """The opposite of contents()."""
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
    """Those of a folder, or of one file."""
    return {key: data for key, data in files.items() if key == name or key.startswith(name + "/")}


def differences(got, expected, most=3):
    """In words; empty: none."""
    found = [f"no {name}" for name in expected if name not in got]
    found += [f"{name} is new" for name in got if name not in expected]
    found += [f"{name} differs" for name in got if name in expected and got[name] != expected[name]]
    return ", ".join(found[:most]) + (f" and {len(found) - most} more" if len(found) > most else "")
