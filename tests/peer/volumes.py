"""Records the 3D textures that a program uploads (record_volumes.c), and compares those of two programs."""
import subprocess
from pathlib import Path

import numpy as np

SOURCE = Path(__file__).resolve().parent / "record_volumes.c"


def build_recorder(folder):
    """Compiles the library to preload; returns its path."""
    folder.mkdir(parents=True, exist_ok=True)
    library = folder / "record_volumes.so"
    subprocess.run(["gcc", "-shared", "-fPIC", "-O1", "-o", str(library), str(SOURCE), "-ldl"], check=True)
    return library


def environment(recorder, folder):
    """What a program's environment needs to be recorded to `folder`."""
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.bin"):
        old.unlink()
    return {"LD_PRELOAD": str(recorder), "RECORD_VOLUMES": str(folder)}


def load(folder):
    """Levels' bytes of each texture larger than a texel: {(size of level 0, order of making): {level: bytes}}."""
    textures = {}
    for path in folder.glob("*.bin"):
        raw = path.read_bytes()
        head = np.frombuffer(raw[:32], np.int32)
        textures.setdefault(int(head[0]), {})[int(head[1])] = (tuple(head[2:5].tolist()), np.frombuffer(raw[32:], np.uint8))
    return [textures[name] for name in sorted(textures) if textures[name][0][0] != (1, 1, 1)]


def difference(a, b):
    """Share of bytes that differ, over all levels; 1 if the levels are not the same."""
    if {k: v[0] for k, v in a.items()} != {k: v[0] for k, v in b.items()}:
        return 1.0
    return sum(int((a[k][1] != b[k][1]).sum()) for k in a) / sum(a[k][1].size for k in a)


def match(ours, theirs):
    """For each texture of `theirs` the least share of bytes that differ from one of `ours`: programs make them in
    different orders."""
    left, shares = load(ours), []
    for texture in load(theirs):
        best = min(left, key=lambda t: difference(t, texture), default=None)
        shares.append(1.0 if best is None else difference(best, texture))
        left = [t for t in left if t is not best]
    return shares
