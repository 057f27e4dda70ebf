#!/usr/bin/env python3
"""Holds ground truths of glintmark against Mitsuba 3 (`pip install mitsuba`), which shares nothing with it.

    python3 bench/compare_mitsuba.py area_cloth --view far --set material.cloth.f0=1

exports the view, renders it by both, and prints a line of Markdown: Mitsuba's mean over the truth's with its
standard error from independent seeds, relMSE, and the relMSE that Mitsuba's noise alone makes, also from the
seeds; over pixels that meshes cover with all their neighbours. No test needs it.
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

EPSILON = 1e-2  # of relMSE, as glintmark's


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scene")
    parser.add_argument("--view", help="default: the scene's first")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("--size", default="160x90")
    parser.add_argument("--truth", type=int, default=4096, help="samples a pixel of glintmark")
    parser.add_argument("--seeds", type=int, default=8, help="pictures by Mitsuba, at least 2")
    parser.add_argument("--spp", type=int, default=64, help="samples a pixel of each")
    parser.add_argument("--variant", default="scalar_rgb")
    parser.add_argument("--frame", action="store_true", help="the frame that is shaded, not the truth")
    parser.add_argument("--glintmark", default="build/release/bin/glintmark")
    parser.add_argument("--label", help="first column; default: scene, view, settings")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for the export and both pictures")
    chosen = parser.parse_args()
    if chosen.seeds < 2:
        parser.error("--seeds must be at least 2: the noise comes from their spread")
    return chosen


def run(command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: {done.stderr.strip()}")


def ours(chosen, folder):
    """Exports the view and renders the truth; returns it as RGBA."""
    scene = [chosen.scene] + [word for value in chosen.set for word in ("--set", value)]
    view = ["--view", chosen.view] if chosen.view else []
    common = view + ["--size", chosen.size, "--quiet"]
    run([chosen.glintmark, "export", *scene, *common, "-o", folder / "export"])
    truth = [] if chosen.frame else ["--truth", str(chosen.truth)]
    run([chosen.glintmark, "render", *scene, *common, *truth, "-o", folder / "glintmark.exr"])
    import mitsuba

    return np.array(mitsuba.Bitmap(str(folder / "glintmark.exr")))[:, :, :4].astype(np.float64)


def theirs(chosen, folder):
    """Pictures by Mitsuba, one for each seed."""
    import mitsuba

    scene = mitsuba.load_file(str(folder / "export" / "scene.xml"))
    pictures = [
        np.array(mitsuba.render(scene, seed=seed, spp=chosen.spp)).astype(np.float64)[:, :, :3]
        for seed in range(1, chosen.seeds + 1)
    ]
    mitsuba.Bitmap(np.mean(pictures, axis=0).astype(np.float32)).write(str(folder / "mitsuba.exr"))
    return np.array(pictures)


def inner(alpha):
    """Pixels that are covered and whose neighbours are: on an edge Mitsuba sees past the mesh."""
    covered = np.pad(alpha > 0, 1, mode="edge")
    height, width = alpha.shape
    shifted = [covered[y : y + height, x : x + width] for y in range(3) for x in range(3)]
    return np.logical_and.reduce(shifted)


def row(chosen, picture, pictures):
    covered = inner(picture[:, :, 3])
    if not covered.any():
        sys.exit(f"compare_mitsuba: {chosen.scene} covers no pixel whose neighbours are covered too")
    a, b = picture[covered][:, :3], pictures[:, covered]
    mean, count = b.mean(axis=0), len(b)
    error = b.std(axis=0, ddof=1) / np.sqrt(count)  # of Mitsuba's mean, by pixel
    ratios = b.mean(axis=(1, 2)) / a.mean()
    weight = a * a + EPSILON
    label = chosen.label or " ".join([f"{chosen.scene}/{chosen.view or ''}", *chosen.set])
    return (
        f"| {label} | {ratios.mean():.4f} ± {ratios.std(ddof=1) / np.sqrt(count):.4f} "
        f"| {((a - mean) ** 2 / weight).mean():.2e} | {(error**2 / weight).mean():.2e} |"
    )


def main():
    chosen = arguments()
    try:
        import mitsuba
    except ImportError:
        sys.exit("compare_mitsuba: Mitsuba 3 is not installed; pip install mitsuba")
    mitsuba.set_variant(chosen.variant)
    with tempfile.TemporaryDirectory() as temporary:
        folder = chosen.keep or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        picture = ours(chosen, folder)
        print(row(chosen, picture, theirs(chosen, folder)))


if __name__ == "__main__":
    main()
