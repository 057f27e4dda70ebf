#!/usr/bin/env python3
"""Holds ground truths of glintmark against Mitsuba 3 (`pip install mitsuba`), which shares nothing with it.

    python3 bench/compare_mitsuba.py area_cloth --view far --set material.cloth.f0=1

exports the view, renders it by both, and prints a line of Markdown: Mitsuba's mean over the truth's with its
standard error from independent seeds, relMSE, and the relMSE that Mitsuba's noise alone makes, also from the
seeds; over pixels that meshes cover with all their neighbours. No test needs it.

Meshes throw shadows there and none here: `--unshadowed --variant llvm_ad_rgb` asks Mitsuba's BSDFs and emitters
for the light without shadow rays, and `--no-horizon` the BSDF under its `normalmap`, which cuts light at the
mesh's horizon, in the mapped frame itself.
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile
from xml.etree import ElementTree

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
    parser.add_argument("--unshadowed", action="store_true", help="no shadow rays; a variant of many lanes")
    parser.add_argument("--no-horizon", action="store_true", help="of meshes with one mapped material; unshadowed")
    parser.add_argument("--frame", action="store_true", help="the frame that is shaded, not the truth")
    parser.add_argument("--glintmark", default="build/release/bin/glintmark")
    parser.add_argument("--label", help="first column; default: scene, view, settings")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for the export and both pictures")
    chosen = parser.parse_args()
    if chosen.seeds < 2:
        parser.error("--seeds must be at least 2: the noise comes from their spread")
    chosen.unshadowed = chosen.unshadowed or chosen.no_horizon
    if chosen.unshadowed and chosen.variant.startswith("scalar"):
        parser.error("--unshadowed needs a variant of many lanes: --variant llvm_ad_rgb")
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


class Mapped:
    """The BSDF under the export's one normal map, in frames around the mapped normals."""

    def __init__(self, scene_file):
        import mitsuba

        outer = ElementTree.parse(scene_file).findall(".//bsdf[@type='normalmap']")
        if len(outer) != 1:
            sys.exit(f"compare_mitsuba: --no-horizon needs one mapped material; the export has {len(outer)}")
        texture, inner = outer[0].find("texture"), outer[0].find("bsdf")
        for part in (texture, inner):
            part.set("version", "3.0.0")
        name = texture.find("string[@name='filename']")
        name.set("value", str(scene_file.parent / name.get("value")))
        self.texture, self.inner = (
            mitsuba.load_string(ElementTree.tostring(part, encoding="unicode")) for part in (texture, inner)
        )

    def eval(self, context, surface, towards, active):
        """Of a direction in world axes."""
        import drjit
        import mitsuba

        normal = drjit.normalize(mitsuba.Vector3f(self.texture.eval_3(surface, active)) * 2 - 1)
        turned = mitsuba.SurfaceInteraction3f(surface)
        turned.sh_frame = mitsuba.Frame3f(surface.to_world(normal))
        turned.wi = turned.to_local(surface.to_world(surface.wi))
        return self.inner.eval(context, turned, turned.to_local(towards), active)


def unshadowed(scene, mapped, spp, seed):
    """Radiance by Mitsuba's camera, emitters and BSDFs, as if nothing stood between surface and light."""
    import drjit
    import mitsuba

    sensor = scene.sensors()[0]
    width, height = (int(side) for side in sensor.film().crop_size())
    count = width * height * spp
    sampler = mitsuba.load_dict({"type": "independent"})
    sampler.seed(seed, count)
    pixel = drjit.arange(mitsuba.UInt32, count) // spp
    x, y = mitsuba.Float(pixel % width), mitsuba.Float(pixel // width)
    place = mitsuba.Point2f((x + sampler.next_1d()) / width, (y + sampler.next_1d()) / height)
    ray, _ = sensor.sample_ray(0.0, 0.5, place, mitsuba.Point2f(0.5))
    surface = scene.ray_intersect(ray)
    covered = surface.is_valid()
    bsdf, context, sum_ = surface.bsdf(), mitsuba.BSDFContext(), mitsuba.Color3f(0)
    for emitter in scene.emitters():
        towards, light = emitter.sample_direction(surface, sampler.next_2d(), covered)
        if mapped:
            value = mapped.eval(context, surface, towards.d, covered)
        else:
            value = bsdf.eval(context, surface, surface.to_local(towards.d), covered)
        sum_ += drjit.select(covered, value * light, 0)
    samples = np.stack([np.array(channel) for channel in sum_], axis=1)
    return samples.reshape(height, width, spp, 3).mean(axis=2)


def picture_of(chosen, scene, mapped, seed):
    import mitsuba

    if chosen.unshadowed:
        return unshadowed(scene, mapped, chosen.spp, seed)
    return np.array(mitsuba.render(scene, seed=seed, spp=chosen.spp))


def theirs(chosen, folder):
    """Pictures by Mitsuba, one for each seed."""
    import mitsuba

    scene_file = folder / "export" / "scene.xml"
    scene = mitsuba.load_file(str(scene_file))
    mapped = Mapped(scene_file) if chosen.no_horizon else None
    pictures = [
        picture_of(chosen, scene, mapped, seed).astype(np.float64)[:, :, :3]
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
