"""The report as one HTML page that holds its pictures."""
import base64
import html
import statistics

STYLE = """body{font:14px sans-serif;background:#222;color:#ddd;margin:1em}
table{border-collapse:collapse;margin:.5em 0}td,th{padding:.15em .7em;text-align:right}th:first-child,td:first-child{text-align:left}
tr:nth-child(even){background:#2b2b2b}img{display:block;max-width:100%}
.row{display:grid;grid-template-columns:repeat(3,1fr);gap:4px;margin-bottom:.5em}.bad{color:#f76}"""
HEADS = ("high", "low", "off", "Godot draws our data", "we draw Godot's data")
# What the project promises: mean FLIP of a picture, and of a picture with the other program's data.
WORST = {"high": .035, "low": .035, "Godot draws our data": .01, "we draw Godot's data": .01}


def image(path, title):
    data = base64.b64encode(path.read_bytes()).decode()
    return '<img src="data:image/png;base64,%s" title="%s">' % (data, html.escape(title))


def cell(value, form, bad=False):
    return "<td%s>%s</td>" % (' class="bad"' if bad else "", "" if value is None else form % value)


def table(heads, rows):
    head = "".join("<th>%s</th>" % html.escape(h) for h in heads)
    return "<table><tr>%s</tr>%s</table>" % (head, "".join("<tr>%s</tr>" % r for r in rows))


def flips(result):
    return {p["label"]: p["flip"] for p in result["pictures"] + result["interchange"]}


def flip_table(results):
    rows = []
    for r in results:
        said, t = flips(r), r["times"]
        cells = [cell(said.get(h), "%.4f", said.get(h, 0) > WORST.get(h, 1)) for h in HEADS]
        cells += [cell(t[p].get(k), "%.0f") for p, k in
                  (("Godot", "bake_ms"), ("Conelight", "bake_ms"), ("Godot", "frame_ms"), ("Conelight", "frame_ms"))]
        rows.append('<td><a href="#%s">%s</a></td>' % (r["name"], r["name"]) + "".join(cells))
    means = [[flips(r)[h] for r in results if h in flips(r)] for h in HEADS]
    rows.append("<td>mean</td>" + "".join(cell(statistics.mean(m) if m else None, "%.4f") for m in means))
    rows.append("<td>worst</td>" + "".join(cell(max(m, default=None), "%.4f") for m in means))
    return table(("mean FLIP", *HEADS, "bake ms Godot", "ours", "frame ms Godot", "ours"), rows)


def data_table(results):
    rows = []
    for r in results:
        for name, d in r["data"].items():
            rows.append("<td>%s %s</td>" % (r["name"], html.escape(name)) + cell(d["leaves"], "%d") +
                        cell("equal" if d["header"] else "differs", "%s", not d["header"]) +
                        cell(d["overlap"], "%.5f", d["overlap"] < .999) + cell(d["within_one"], "%.5f", d["within_one"] < .995) +
                        cell(d["equal"], "%.5f"))
    return table(("baked data", "leaves", "header", "IoU of leaves", "within 1", "equal"), rows)


def volume_table(results):
    rows = ["<td>%s</td>" % r["name"] + "".join(cell(100 * share, "%.5f %%", share > 1e-3) for share in r["volumes"])
            for r in results]
    return table(("bytes of the relit volumes that differ, all mips",), rows)


def gallery(result):
    rows = ["<h2 id='%s'>%s</h2>" % (result["name"], result["name"])]
    for p in result["pictures"] + result["interchange"]:
        rows.append("<div>%s: FLIP %.4f, greatest difference %d of 255</div><div class='row'>%s%s%s</div>" % (
            html.escape(p["label"]), p["flip"], p["greatest"], image(p["reference"], "reference"),
            image(p["picture"], "compared"), image(p["difference"], "difference times 8")))
    return "".join(rows)


def page(results):
    return ("<!doctype html><meta charset='utf-8'><title>Conelight and Godot 3.2.3</title><style>%s</style>"
            "<h1>Conelight and Godot 3.2.3</h1><p>Left Godot (or the reference), middle Conelight (or the compared), right "
            "their difference times 8.</p>%s%s%s%s") % (STYLE, flip_table(results), data_table(results), volume_table(results),
                                                       "".join(gallery(r) for r in results))
