"""FLIP and difference pictures of two 8-bit pictures of the same size."""
import flip_evaluator
import numpy as np
from PIL import Image


def load(path):
    return np.asarray(Image.open(path).convert("RGB"))


def flip(reference, picture):
    """Mean FLIP (Andersson et al. 2020, LDR, 67 pixels per degree) of two files."""
    a, b = (np.ascontiguousarray(load(p).astype(np.float32) / 255) for p in (reference, picture))
    _, mean, _ = flip_evaluator.evaluate(a, b, "LDR", applyMagma=False)
    return float(mean)


def write_difference(reference, picture, path, gain=8):
    """Absolute difference of the 8-bit values times `gain`; black is equal. Returns the greatest difference."""
    d = np.abs(load(reference).astype(int) - load(picture).astype(int))
    Image.fromarray(np.minimum(d * gain, 255).astype(np.uint8)).save(path)
    return int(d.max())
