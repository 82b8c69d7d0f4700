# SPDX-License-Identifier: GPL-3.0-or-later
"""Computes what a disc contains after a loss of power, from the trace of a process's operations on files.

Each write to a file since its last fsync may be present or lost, in any order. The same holds for names in a folder that were made, changed
or removed since the folder's last fsync. syncfs acts as fsync on all files and folders."""

from dataclasses import dataclass
from pathlib import PurePosixPath


@dataclass
class Operation:
    kind: str
    path: str
    offset: int
    data: bytes


def read_trace(file, folder):
    """The traced operations, with paths relative to the folder."""
    bytes_, at, found = file.read_bytes(), 0, []
    prefix = str(folder) + "/"

    def relative(path):
        return path.removeprefix(prefix) if path.startswith(prefix) else "."
    while at < len(bytes_):
        end = bytes_.index(b"\n", at)
        kind, offset, path_length, data_length = bytes_[at:end].decode().split()
        path_end = end + 1 + int(path_length)
        data_end = path_end + int(data_length)
        path, data = bytes_[end + 1:path_end].decode(), bytes_[path_end:data_end]
        if kind == "rename":
            data = relative(data.decode()).encode()
        found.append(Operation(kind, relative(path), int(offset), data))
        at = data_end + 1
    return found


def changed(content, operation):
    """A file's bytes after a write or truncation."""
    if operation.kind == "truncate":
        return content[:operation.offset].ljust(operation.offset, b"\0")
    end = operation.offset + len(operation.data)
    return content[:operation.offset].ljust(operation.offset, b"\0") + operation.data + content[end:]


class File:
    def __init__(self, durable):
        self.durable, self.pending = durable, []

    def content(self, pending):
        found = self.durable
        for operation in pending:
            found = changed(found, operation)
        return found


class Disc:
    def __init__(self, before):
        """before: contents() of the folder, completely on the disc."""
        self.now = {name: None if name.endswith("/") else File(data) for name, data in before.items()}
        self.now = {name.rstrip("/"): file for name, file in self.now.items()}
        self.names = dict(self.now)  # files and folders by their names on the disc
        self.pending = []  # changes of names that are not on the disc: (folders, {name: file, or "gone"})

    def name(self, folders, changes):
        self.pending.append((folders, changes))
        apply_names(self.now, changes)

    def do(self, operation):
        path, folder = operation.path, str(PurePosixPath(operation.path).parent)
        if operation.kind == "create":
            self.name({folder}, {path: File(b"")})
        elif operation.kind == "mkdir":
            self.name({folder}, {path: None})
        elif operation.kind == "unlink":
            self.name({folder}, {path: "gone"})
        elif operation.kind == "rename":
            target = operation.data.decode()
            moved = {name: file for name, file in self.now.items() if name == path or name.startswith(path + "/")}
            changes = {name: "gone" for name in moved} | {target + name[len(path):]: file for name, file in moved.items()}
            self.name({folder, str(PurePosixPath(target).parent)}, changes)
        elif operation.kind in ("write", "truncate"):
            self.now[path].pending.append(operation)
        elif operation.kind == "syncfs":
            for file in {*self.names.values(), *self.now.values()}:
                if file is not None:
                    file.durable, file.pending = file.content(file.pending), []
            self.names, self.pending = dict(self.now), []
        elif operation.kind == "fsync":
            file = self.now.get(path)
            if isinstance(file, File):
                file.durable, file.pending = file.content(file.pending), []
            else:  # a folder
                kept = []
                for folders, changes in self.pending:
                    if path in folders:
                        apply_names(self.names, changes)
                    else:
                        kept.append((folders, changes))
                self.pending = kept

    def after_loss(self, data="lost", names="lost", random=None):
        """{name: bytes} as from contents(). data, names: what happens to changes that are not on the disc: lost, kept or chance"""
        found = dict(self.names)
        for _, changes in self.pending:
            if names == "kept" or (names == "chance" and random.random() < 0.5):
                apply_names(found, changes)
        files = {}
        for name, file in found.items():
            if any(str(parent) not in found for parent in PurePosixPath(name).parents if str(parent) != "."):
                continue  # its folder was lost
            if file is None:
                files[f"{name}/"] = b""
                continue
            pending = file.pending if data == "kept" else []
            if data == "chance":
                pending = [operation for operation in file.pending if random.random() < 0.5]
                random.shuffle(pending)
            files[name] = file.content(pending)
        return files


def apply_names(names, changes):
    for name, file in changes.items():
        if file == "gone":
            names.pop(name, None)
        else:
            names[name] = file
