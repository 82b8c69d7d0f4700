# SPDX-License-Identifier: GPL-3.0-or-later
"""Real places that cannot be written: a small file system in memory that fills up, and a folder without permission."""

import os
import shutil
import subprocess

from judgement import UNREACHED, UNTOUCHED, judge
from program import Call

NOBODY = 65534
PAGE = 4  # kB
MOST = 1 << 16  # kB, enough for every scene


class NotHere(Exception):
    """The reason why something cannot be tried."""


def mounted(folder, kilobytes, again=False):
    if os.geteuid() != 0:
        raise NotHere("mount: only root may")
    options = ("remount," if again else "") + f"size={kilobytes}k,mode=755"
    done = subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", str(folder)], capture_output=True, text=True)
    if done.returncode:
        raise NotHere(f"mount: {done.stderr.strip()}")


def unmounted(folder):
    subprocess.run(["umount", str(folder)], check=True)


def copied(origin, folder):
    for path in sorted(origin.rglob("*")):
        target = folder / path.relative_to(origin)
        target.mkdir() if path.is_dir() else shutil.copyfile(path, target)


def pages(folder):
    return sum(-(-path.stat().st_size // (1024 * PAGE)) for path in folder.rglob("*") if path.is_file())


def full_disc(program, scene, place, origin, quick):
    """Runs the command on larger and larger discs until it succeeds. @yield outcomes, each with the size in kilobytes"""
    work, used, more = place / "work", pages(origin / "before"), 0
    while True:
        shutil.rmtree(work, ignore_errors=True)
        work.mkdir(parents=True)
        size = max(1, used + more) * PAGE  # 0 would mean no limit
        mounted(work, size)
        try:
            copied(origin / "before", work)
            run = program.run(scene.command, place)
            run.calls = [Call("write", 0, scene.results[0])]
            outcome = judge(program, scene, place, run, "ENOSPC", mend=lambda: mounted(work, MOST, again=True))
        finally:
            unmounted(work)
        yield outcome, size
        if outcome.kind in (UNTOUCHED, UNREACHED):
            return
        more = 4 * more + 1 if quick else more + max(1, more // 6)


def read_only(program, scene, place, origin):
    """Runs the command as a user who may not write the folder."""
    if os.geteuid() != 0 or shutil.which("setpriv") is None:
        raise NotHere("setpriv: only root may become someone else")
    scene.restore(place, origin)
    work = place / "work"
    as_nobody = ["setpriv", f"--reuid={NOBODY}", f"--regid={NOBODY}", "--clear-groups"]
    for path in [*work.rglob("*"), work]:
        path.chmod(0o555 if path.is_dir() else 0o444)
    for parent in place.parents:
        if not os.stat(parent).st_mode & 0o001:
            raise NotHere(f"{parent}: not open to others")
    reachable = subprocess.run([*as_nobody, str(program.program), "--version"], capture_output=True)
    if reachable.returncode:
        raise NotHere(f"{program.program}: cannot be started by others")
    run = program.run(scene.command, place, before=as_nobody)
    run.calls = [Call("open", 0, scene.results[0])]

    def writable():
        for path in [*work.rglob("*"), work]:
            path.chmod(0o755 if path.is_dir() else 0o644)
    return judge(program, scene, place, run, "EACCES", mend=writable)
