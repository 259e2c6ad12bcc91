"""Compares baked GIProbeData of two programs, cell by cell."""
import re

import numpy as np

NONE = 0xFFFFFFFF


class Data:
    """A GIProbeData text resource: header fields, and its leaves by place."""

    def __init__(self, path):
        text = path.read_text()
        self.properties = {}
        for line in text.split("\n"):
            name, equals, rest = line.partition(" = ")
            if equals and name in ("bounds", "cell_size", "to_cell_xform", "dynamic_range", "energy", "bias", "normal_bias",
                                   "propagation", "interior", "compress"):
                self.properties[name] = rest
        begin = text.index("dynamic_data = PoolIntArray(") + len("dynamic_data = PoolIntArray(")
        ints = np.array(text[begin:text.index(")", begin)].split(","), dtype=np.int64).astype(np.uint32)
        self.header = ints[:7].tolist()
        self.cells = ints[16:].reshape(-1, 12)
        self.keys, self.leaves = self._leaves()

    def _leaves(self):
        """Sorted keys of the leaves' places, and their rows [albedo, emission, normal, level and alpha]."""
        index, place = np.zeros(1, np.int64), np.zeros((1, 3), np.int64)
        for level in range(self.header[1] - 1):
            half = 1 << (self.header[1] - 2 - level)
            children = self.cells[index, :8]
            parent, slot = np.nonzero(children != NONE)
            place = place[parent] + half * np.stack([slot & 1, (slot >> 1) & 1, slot >> 2], axis=1)
            index = children[parent, slot].astype(np.int64)
        key = (place[:, 2] << 20 | place[:, 1] << 10 | place[:, 0])
        order = np.argsort(key)
        return key[order], self.cells[index[order], 8:]


NUMBER = re.compile(r"-?\d[\d.]*(?:e[-+]?\d+)?")


def same_property(a, b):
    """Equal texts but for the digits after the sixth, which Godot does not write."""
    numbers = [[float(n) for n in NUMBER.findall(text)] for text in (a, b)]
    return NUMBER.sub("", a) == NUMBER.sub("", b) and np.allclose(*numbers, rtol=1e-5, atol=1e-6)


def same_header(a, b):
    return (a.header == b.header and a.properties.keys() == b.properties.keys() and
            all(same_property(v, b.properties[k]) for k, v in a.properties.items()))


def bytes_of(words):
    return np.ascontiguousarray(words.astype("<u4")).view(np.uint8).reshape(len(words), -1).astype(int)


def match(ours, theirs):
    """{"header": equal?, "overlap": IoU of leaves, "within_one": share of common leaves whose bytes all are within 1}."""
    a, b = Data(ours), Data(theirs)
    _, ia, ib = np.intersect1d(a.keys, b.keys, assume_unique=True, return_indices=True)
    union = len(a.keys) + len(b.keys) - len(ia)
    difference = np.abs(bytes_of(a.leaves[ia]) - bytes_of(b.leaves[ib]))
    near = (difference <= 1).all(axis=1)
    return {"header": same_header(a, b),
            "overlap": len(ia) / union if union else 1.0, "within_one": float(near.mean()) if len(near) else 1.0,
            "equal": float((difference == 0).all(axis=1).mean()) if len(near) else 1.0, "leaves": len(b.keys)}
