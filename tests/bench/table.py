"""Rows of measured values: medians, spread, ratios."""
import statistics


class Row:
    def __init__(self, scene, name):
        self.scene, self.name, self.ours, self.godot = scene, name, [], []

    def add(self, ours, godot):
        self.ours.append(ours)
        self.godot.append(godot)

    def ratio(self):
        """Of the medians, ours to Godot's."""
        below = statistics.median(self.godot)
        return statistics.median(self.ours) / below if below > 0 else float("nan")

    def as_json(self):
        return {"scene": self.scene, "name": self.name, "ours": self.ours, "godot": self.godot, "ratio": self.ratio()}


def spread(values):
    return "%8.1f [%8.1f, %8.1f]" % (statistics.median(values), min(values), max(values))


def print_table(rows):
    """Times in milliseconds, memory in MiB."""
    print("%-16s %-32s %29s %29s %7s" % ("scene", "", "Conelight", "Godot 3.2.3", "ratio"))
    for r in rows:
        print("%-16s %-32s %29s %29s %7.3f" % (r.scene, r.name, spread(r.ours), spread(r.godot), r.ratio()))
