"""Pictures as linear radiance, read and compared: float64 [height, width, 3]."""
import struct
import zlib
from pathlib import Path

import flip_evaluator
import numpy as np
from PIL import Image


def linear(encoded):
    """sRGB, 0..1, decoded."""
    return np.where(encoded <= .04045, encoded / 12.92, ((encoded + .055) / 1.055) ** 2.4)


def srgb(radiance):
    c = np.clip(radiance, 0, 1)
    return np.where(c <= .0031308, 12.92 * c, 1.055 * c ** (1 / 2.4) - .055)


def load(path):
    """A .png (sRGB), .exr (as conelight writes it) or .npz (under the key `truth`)."""
    path = Path(path)
    if path.suffix == ".npz":
        return np.load(path)["truth"].astype(np.float64)
    if path.suffix == ".exr":
        return load_exr(path)
    return linear(np.asarray(Image.open(path).convert("RGB")).astype(np.float64) / 255)


def save(path, radiance):
    Image.fromarray(np.round(srgb(radiance) * 255).astype(np.uint8)).save(path)


def load_exr(path):
    """Scan lines of 32-bit floats, uncompressed or ZIP. Source: "OpenEXR File Layout", openexr.com."""
    data = path.read_bytes()
    at, attributes = 8, {}
    while data[at]:
        name, kind = (data[at:].split(b"\0", 2))[:2]
        at += len(name) + len(kind) + 2
        size, = struct.unpack_from("<i", data, at)
        attributes[name.decode()] = data[at + 4:at + 4 + size]
        at += 4 + size
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    names, rest = [], attributes["channels"]
    while rest[0]:
        name, rest = rest.split(b"\0", 1)
        names.append(name.decode())
        if struct.unpack_from("<i", rest)[0] != 2:
            raise SystemExit(f"{path}: expected channels of 32-bit floats")
        rest = rest[16:]
    lines = {0: 1, 2: 1, 3: 16}[attributes["compression"][0]]
    out = np.zeros((height, len(names), width), np.float32)
    for offset in struct.unpack_from(f"<{-(-height // lines)}Q", data, at + 1):
        y, size = struct.unpack_from("<ii", data, offset)
        count = min(lines, height - (y - y0))
        raw = inflate(data[offset + 8:offset + 8 + size], count * len(names) * width * 4)
        out[y - y0:y - y0 + count] = np.frombuffer(raw, "<f4").reshape(count, len(names), width)
    return np.stack([out[:, names.index(c)] for c in "RGB"], axis=2).astype(np.float64)


def inflate(packed, size):
    """A block of EXR's ZIP compression: differences of bytes, low halves first."""
    if len(packed) == size:
        return packed
    deltas = np.frombuffer(zlib.decompress(packed), np.uint8).astype(np.int64)
    deltas[1:] -= 128
    flat = (np.cumsum(deltas) & 255).astype(np.uint8)
    out = np.empty(size, np.uint8)
    half = (size + 1) // 2
    out[0::2], out[1::2] = flat[:half], flat[half:]
    return out.tobytes()


def flip_map(picture, truth):
    """FLIP (Andersson et al. 2020) of each pixel, low dynamic range, 67 pixels a degree."""
    a, b = (np.ascontiguousarray(srgb(x).astype(np.float32)) for x in (truth, picture))
    return flip_evaluator.evaluate(a, b, "LDR", applyMagma=False)[0].reshape(truth.shape[:2])


def luminance(radiance):
    return radiance @ np.array([.2126, .7152, .0722])


def compare(picture, truth):
    """flip: mean. worst: its 99th percentile. rmse: of linear radiance clamped to 0..1. energy: mean over mean, likewise
    clamped; infinite where the truth is black. worst_pixels: the five with the largest FLIP, (x, y), a patch apart."""
    a, t = np.clip(picture, 0, 1), np.clip(truth, 0, 1)
    errors = flip_map(a, t)
    mean = t.mean()
    energy = a.mean() / mean if mean > 0 else (float("inf") if a.mean() > 0 else 1.0)
    return {"flip": float(errors.mean()), "worst": float(np.percentile(errors, 99)), "map": errors,
            "rmse": float(np.sqrt(((a - t) ** 2).mean())), "energy": float(energy),
            "worst_pixels": worst_pixels(errors, a, t)}


def worst_pixels(errors, picture, truth, count=5, apart=16):
    left, found = errors.copy(), []
    for _ in range(count):
        y, x = np.unravel_index(int(np.argmax(left)), left.shape)
        found.append({"x": int(x), "y": int(y), "flip": float(errors[y, x]), "found": picture[y, x].tolist(),
                      "expected": truth[y, x].tolist()})
        left[max(0, y - apart):y + apart + 1, max(0, x - apart):x + apart + 1] = -1
    return found
