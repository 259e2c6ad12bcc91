"""Scenes that are made from others, or from nothing, for measuring."""
import re
from pathlib import Path

NODE = re.compile(r'^\[node name="([^"]*)" type="(Omni|Spot|Directional)Light"[^\]]*\]\n(?:(?!\[).*\n?)*', re.M)
ORIGIN = re.compile(r"(transform = Transform\((?:[^,)]*,){9})([^,)]*),([^,)]*),([^,)]*)\)")
ENERGY = re.compile(r"^light_energy = (.*)$", re.M)


def with_lights(scene, folder, count):
    """A copy of `scene` in which `count` lights stand where its first one did, a hand's breadth apart.

    All have a `count`th of its energy; only the first keeps its shadow map. None if it has no light itself.
    """
    text = Path(scene).read_text()
    found = NODE.search(text)
    if not found:
        return None
    block = found.group(0).rstrip("\n") + "\n"
    energy = ENERGY.search(block)
    share = float(energy.group(1) if energy else 1.0) / count
    block = ENERGY.sub("", block)

    def copy(i):
        own = block.replace(f'name="{found.group(1)}"', f'name="{found.group(1)}{i}"' if i else
                            f'name="{found.group(1)}"', 1)
        own = ORIGIN.sub(lambda m: "%s %g, %g, %g)" % (m.group(1), float(m.group(2)) + 0.1 * (i % 4),
                                                       float(m.group(3)), float(m.group(4)) + 0.1 * (i // 4)), own)
        own = re.sub(r"^shadow_enabled = .*\n", "", own, flags=re.M) if i else own
        return own + f"light_energy = {share:g}\n\n"

    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{Path(scene).stem}_{count}_lights.tscn"
    path.write_text(text[:found.start()] + "".join(copy(i) for i in range(count)) + text[found.end():])
    return path
