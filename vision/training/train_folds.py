#!/usr/bin/python3
"""Train the outline network by folds of pictures, score each on what it never saw, then train it on all.

usage: train_folds.py OUT SYNTHETIC FOLDER... [--folds N] [--parts 0 1 2,3] [--jobs N]

SYNTHETIC is a folder made by the program synthetic_photos. Written: OUT/start (synthetic pictures
alone), OUT/fold_P for every part P of the folds (the left-out pictures' fields among it),
OUT/folds.json with their figures, and OUT/all, the network to ship with its card. All are trained
alike. What is already there is kept, so an interrupted run goes on.
"""
import argparse
import glob
import hashlib
import json
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import cv2
import numpy as np
import torch
from scipy import ndimage as ndi
from skimage.morphology import h_maxima
from skimage.segmentation import watershed

from common import score
from outline_data import load_folders
from outline_net import OutlineNet, field_of, write_onnx

HERE = os.path.dirname(os.path.abspath(__file__))


def train(out, folders, *more):
    if not os.path.exists(os.path.join(out, "card.md")):
        subprocess.run([sys.executable, os.path.join(HERE, "train_network.py"), out, *folders, "--threads", "1", *map(str, more)],
                       check=True, env={**os.environ, "OMP_NUM_THREADS": "1"}, stdout=subprocess.DEVNULL)
    return os.path.join(out, "weights.pt")


def mean_of(out, args, fold=""):
    """The network between its last two rounds; the fields of the pictures left out beside it.

    The last round sees many things, which costs rocks; the mean with the one before keeps most of both.
    """
    left_out = set(map(int, fold.split(","))) if fold else set()
    parts = (out + "_second", out + "_third")
    states = [torch.load(os.path.join(p, "weights.pt")) for p in parts]
    net = OutlineNet()
    net.load_state_dict({k: sum(s[k].float() for s in states).div(len(states)).to(v.dtype) for k, v in states[0].items()})
    net.eval()
    os.makedirs(out, exist_ok=True)
    torch.save(net.state_dict(), os.path.join(out, "weights.pt"))
    write_onnx(net, os.path.join(out, "network.onnx"))
    for p in load_folders(args.folders, args.folds):
        if p.fold in left_out:
            field_of(net, p.rgb[0]).astype(np.float32).tofile(os.path.join(out, p.name.replace("/", "_") + ".f32"))
    with open(os.path.join(out, "network.onnx"), "rb") as file:
        digest = hashlib.sha256(file.read()).hexdigest()
    with open(os.path.join(parts[-1], "card.md")) as file:
        card = re.sub(r"`[0-9a-f]{64}`", f"`{digest}`", file.read())
    with open(os.path.join(out, "card.md"), "w") as file:
        file.write(card + "\nThe weights are the mean of those after the last two rounds.\n")


def rounds(out, args, start, fold=""):
    """The rate falls to zero in each round; the later ones have things that are no rocks."""
    more = ("--folds", args.folds, "--fold", fold) if fold else ()
    for k, folder in enumerate((out + "_first", out + "_second", out + "_third")):
        start = train(folder, args.folders, "--extra", args.synthetic, "--extra-share", args.shares[k], "--start", start,
                      "--rate", args.rates[k], "--steps", args.steps[k], "--things", args.things[k], "--seed", 10 + k, *more)


def regions(field):
    """Plain watershed from the heights of the distance channel, the simplest reading of a field."""
    boundary, inside, distance = field
    d = cv2.GaussianBlur(distance, (0, 0), 1.0)
    markers = ndi.label(h_maxima(d, 0.12) * (d > 0.3) * (inside > 0.4))[0]
    return watershed(boundary - 0.5 * d, markers, mask=inside > 0.5)


def figures(out, folders):
    rows = []
    for folder in folders:
        for labels in sorted(glob.glob(os.path.join(folder, "*_labels.png"))):
            name = f"{os.path.basename(os.path.normpath(folder))}/{os.path.basename(labels)[:-len('_labels.png')]}"
            found = [f for f in glob.glob(os.path.join(out, "fold_*", name.replace("/", "_") + ".f32"))
                     if not os.path.dirname(f).endswith(("_first", "_second", "_third"))]
            truth = cv2.imread(labels, cv2.IMREAD_UNCHANGED)
            field = np.fromfile(found[0], np.float32).reshape(3, *truth.shape)
            rows.append({"name": name, **score(regions(field), truth)})
            print(f"{name:36s} AP50 {rows[-1]['AP50']:.3f} IoU {rows[-1]['IoU']:.3f}", flush=True)
    return rows


def main():
    a = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    a.add_argument("out")
    a.add_argument("synthetic")
    a.add_argument("folders", nargs="+")
    a.add_argument("--start-steps", type=int, default=1500, help="on synthetic pictures alone")
    a.add_argument("--steps", type=int, nargs=3, default=[2200, 2400, 600], help="in three rounds")
    a.add_argument("--rates", type=float, nargs=3, default=[2e-3, 2e-3, 1e-3], help="at which each round begins")
    a.add_argument("--shares", type=float, nargs=3, default=[0.25, 0.1, 0.3], help="of synthetic crops in each round")
    a.add_argument("--things", type=float, nargs=3, default=[0, 0.15, 0.3], help="share of crops with a thing over them in each round")
    a.add_argument("--folds", type=int, default=6, help="into which the pictures of every folder are dealt")
    a.add_argument("--parts", nargs="*", help="folds left out together, with commas; each by itself if not given")
    a.add_argument("--jobs", type=int, default=2)
    args = a.parse_args()
    start = train(os.path.join(args.out, "start"), [args.synthetic], "--steps", args.start_steps, "--seed", 5)
    parts = args.parts if args.parts is not None else [str(f) for f in range(args.folds)]
    with ThreadPoolExecutor(args.jobs) as pool:
        list(pool.map(lambda p: rounds(os.path.join(args.out, "fold_" + p), args, start, p), parts))
    for p in parts:  # one by one: torch writes one ONNX file at a time
        mean_of(os.path.join(args.out, "fold_" + p), args, p)
    with open(os.path.join(args.out, "folds.json"), "w") as file:
        json.dump(figures(args.out, args.folders), file, indent=1)
    rounds(os.path.join(args.out, "all"), args, start)  # its card has the figures
    mean_of(os.path.join(args.out, "all"), args)


if __name__ == "__main__":
    main()
