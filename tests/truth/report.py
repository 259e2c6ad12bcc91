#!/usr/bin/env python3
"""Draws every scene of a folder in all modes of global illumination, holds them against path-traced truth and writes one
page: pictures, FLIP maps, energy ratios, worst pixels and a table.

usage: tests/truth/run report [FOLDER...] [--truth DIR] [--modes off,cones,auto] [--out DIR]
Truth is what `conelight reference` draws, kept in the output folder between runs, or NAME.npz, .exr or .png of --truth.
"""
import argparse
import html
import json
import os
import sys
from pathlib import Path

import numpy as np
from PIL import Image

import pictures
from conelight import Conelight, Failed

HERE = Path(__file__).resolve().parent
STYLE = """body { font: 15px sans-serif; margin: 2em; background: #fafafa; } table { border-collapse: collapse; }
td, th { padding: .2em .7em; text-align: right; border-bottom: 1px solid #ddd; } td:first-child { text-align: left; }
figure { display: inline-block; margin: 0 .5em .5em 0; } figcaption { font-size: 13px; color: #444; }
img { width: 360px; display: block; } .off { color: #a00; font-weight: bold; }"""
BARS = {"flip": (0, .10), "energy": (.93, 1.07)}


def truth_of(scene, args, tracer):
    """The truth's picture, from a file or traced now; None if there is no way to it."""
    if args.truth:
        files = [args.truth / (scene.stem + end) for end in (".npz", ".exr", ".png")]
        found = next((f for f in files if f.exists()), None)
        return None if found is None else pictures.load(found)
    if tracer is None:
        return None
    kept = args.out / "truth" / f"{scene.stem}_{args.size}_{args.spp}_{args.seed}.exr"
    if not kept.exists() or kept.stat().st_mtime < scene.stat().st_mtime:
        kept.parent.mkdir(parents=True, exist_ok=True)
        half = kept.with_suffix(".half.exr")
        tracer.reference(scene, half, args.spp, args.seed)
        os.replace(half, kept)
    return pictures.load(kept)


def write_map(path, errors):
    """FLIP 0..1 as black, red, yellow, white."""
    levels = np.clip(errors[..., None] * 3 - np.array([0, 1, 2]), 0, 1)
    Image.fromarray((levels * 255).astype(np.uint8)).save(path)


def measure(scene, args, program, tracer):
    """One scene: {mode: figures}. Pictures go beside the page."""
    truth = truth_of(scene, args, tracer)
    if truth is not None:
        pictures.save(args.out / f"{scene.stem}_truth.png", truth)
    rows = {}
    for mode in args.modes.split(","):
        png = args.out / f"{scene.stem}_{mode}.png"
        stats = program.render(scene, [png], "--gi", mode, stats=args.out / f"{scene.stem}_{mode}.json")
        rows[mode] = {"frame_ms": stats.get("frame_ms"), "relight_ms": stats.get("relight_ms")}
        if truth is not None:
            compared = pictures.compare(pictures.load(png), truth)
            write_map(args.out / f"{scene.stem}_{mode}_flip.png", compared.pop("map"))
            rows[mode] |= compared
    return rows


def cell(key, value):
    if value is None:
        return "<td>-</td>"
    low, high = BARS.get(key, (-np.inf, np.inf))
    kind = "" if low <= value <= high else ' class="off"'
    return f"<td{kind}>{value:.4g}</td>"


def table(results):
    keys = ("flip", "worst", "energy", "rmse", "frame_ms", "relight_ms")
    out = ["<table><tr><th>scene</th><th>mode</th>" + "".join(f"<th>{k}</th>" for k in keys) + "</tr>"]
    for name, rows in results.items():
        for mode, row in rows.items():
            cells = "".join(cell(k, row.get(k)) for k in keys)
            out.append(f'<tr><td><a href="#{html.escape(name)}">{html.escape(name)}</a></td><td>{mode}</td>{cells}</tr>')
    for mode, row in means(results).items():
        out.append(f"<tr><td><b>mean</b></td><td>{mode}</td>" + "".join(cell(k, row.get(k)) for k in keys) + "</tr>")
    return "\n".join(out) + "</table>"


def means(results):
    out = {}
    for mode in dict.fromkeys(m for rows in results.values() for m in rows):
        flips = [rows[mode]["flip"] for rows in results.values() if "flip" in rows.get(mode, {})]
        if flips:
            out[mode] = {"flip": float(np.mean(flips))}
    return out


def figure(file, caption):
    return f'<figure><img src="{html.escape(file)}" alt=""><figcaption>{html.escape(caption)}</figcaption></figure>'


def section(name, rows, out):
    parts = [f'<h2 id="{html.escape(name)}">{html.escape(name)}</h2>']
    if (out / f"{name}_truth.png").exists():
        parts.append(figure(f"{name}_truth.png", "truth"))
    for mode, row in rows.items():
        parts.append(figure(f"{name}_{mode}.png", mode))
        if "flip" in row:
            parts.append(figure(f"{name}_{mode}_flip.png", f"{mode}: FLIP {row['flip']:.3f}, energy {row['energy']:.3f}"))
    for mode, row in rows.items():
        for p in row.get("worst_pixels", []):
            shown = [" ".join(f"{v:.3f}" for v in p[k]) for k in ("found", "expected")]
            parts.append(f"<div>{mode}: ({p['x']}, {p['y']}) FLIP {p['flip']:.2f}, "
                         f"found {shown[0]}, expected {shown[1]}</div>")
    return "\n".join(parts)


def write_page(results, out):
    body = [table(results)] + [section(name, rows, out) for name, rows in results.items()]
    page = (f'<!DOCTYPE html><html lang="en"><meta charset="utf-8"><title>Conelight against the truth</title>'
            f"<style>{STYLE}</style><h1>Conelight against the truth</h1>{chr(10).join(body)}</html>\n")
    (out / "index.html").write_text(page, encoding="utf-8")
    (out / "results.json").write_text(json.dumps(results, indent=1), encoding="utf-8")


def arguments():
    p = argparse.ArgumentParser(prog="tests/truth/run report", description=__doc__.split("\n\n")[0])
    p.add_argument("folders", nargs="*", type=Path, default=[HERE / "scenes"], help="folders of .tscn scenes, or scenes")
    p.add_argument("--truth", type=Path, help="folder of NAME.npz, .exr or .png to hold against, instead of path tracing")
    p.add_argument("--program", type=Path, help="the conelight to measure (default: bin/conelight)")
    p.add_argument("--reference-program", type=Path, help="the conelight that path traces (default: the same)")
    p.add_argument("--modes", default="off,cones,auto")
    p.add_argument("--size", default="480x270", metavar="WxH")
    p.add_argument("--spp", type=int, default=1024, help="paths a pixel of the truth")
    p.add_argument("--seed", type=int, default=0)
    p.add_argument("--out", type=Path, default=Path("build/truth"), help="folder of the page")
    return p.parse_args()


def main():
    args = arguments()
    size = tuple(map(int, args.size.split("x")))
    program = Conelight(args.program, size)
    tracer = Conelight(args.reference_program, size) if args.reference_program else program
    if not args.truth and not tracer.has_reference():
        print(f"skipped the truth: {tracer.program} has no command `reference`; give --truth")
        tracer = None
    args.out.mkdir(parents=True, exist_ok=True)
    scenes = [s for f in args.folders for s in ([f] if f.is_file() else sorted(f.glob("*.tscn")))]
    results, failed = {}, 0
    for scene in scenes:
        try:
            results[scene.stem] = measure(scene, args, program, tracer)
        except Failed as error:
            failed += 1
            print(f"{scene.stem}: {error}", flush=True)
            continue
        for mode, row in results[scene.stem].items():
            if "flip" in row:
                print(f"{scene.stem:18} {mode:6} flip {row['flip']:.4f}  p99 {row['worst']:.3f}  "
                      f"energy {row['energy']:.4f}", flush=True)
        write_page(results, args.out)
    for mode, row in means(results).items():
        print(f"{'mean':18} {mode:6} flip {row['flip']:.4f}")
    print(f"{args.out / 'index.html'}: {len(results)} scenes, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
