#!/usr/bin/python3
"""Score `scree rocks` on folders of labelled photographs, and what the refinement gains there.

usage: score_photos.py DATA [--scree PROGRAM] [--method METHOD] [--refinement] [FOLDER ...]

DATA holds folders (default: gravel outcrop sand) of *_image.* beside *_labels.png. Prints a row a
photograph and a mean a folder: the figures of docs/benchmarks.md. With --refinement every
photograph is run a second time without the refinement, and the gain in IoU is printed over the
rocks that are matched with and without it.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import cv2
import numpy as np

KEYS = ["AP50", "AP75", "mAP", "F1", "IoU", "cover", "D50err", "D84err"]


def run(program, *words):
    done = subprocess.run([program, *map(str, words)], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{program} {' '.join(map(str, words))}\n{done.stderr}")
    return done.stdout


def best_iou(pred, truth):
    """For every true rock the IoU with the prediction that covers it best."""
    n = int(pred.max()) + 1
    both = np.bincount(truth.ravel().astype(np.int64) * n + pred.ravel(), minlength=(int(truth.max()) + 1) * n)
    both = both.reshape(-1, n).astype(float)
    union = both.sum(1)[1:, None] + both.sum(0)[None, 1:] - both[1:, 1:]
    iou = both[1:, 1:] / np.maximum(union, 1)
    return iou.max(1) if iou.shape[1] else np.zeros(len(iou))


def pairs(folder):
    for photo in sorted(folder.glob("*_image.*")):
        labels = photo.with_name(photo.stem[: -len("_image")] + "_labels.png")
        if labels.exists():
            yield photo, labels


def find(args, photo, scratch, *more):
    out = pathlib.Path(scratch) / (photo.stem + "".join(more))
    run(args.scree, "rocks", photo, "-o", out, "--quiet", "--method", args.method, *more)
    return out / "labels.png"


def score(args, folder, scratch):
    rows = []
    for photo, labels in pairs(folder):
        found = find(args, photo, scratch)
        report = json.loads(run(args.scree, "score", found, labels, "--json"))
        row = report["pictures"][0] if isinstance(report["pictures"], list) else next(iter(report["pictures"].values()))
        text = f"{photo.stem[:-6]:28s} {row['truth']:5d} {row['pred']:5d} " + " ".join(f"{row[k]:6.3f}" for k in KEYS)
        if args.refinement:
            plain = best_iou(cv2.imread(str(find(args, photo, scratch, "--no-refine")), -1), cv2.imread(str(labels), -1))
            fine = best_iou(cv2.imread(str(found), -1), cv2.imread(str(labels), -1))
            both = (plain > 0.5) & (fine > 0.5)
            row["gain"] = float((fine - plain)[both].mean()) if both.any() else 0.0
            text += f" {plain[both].mean():6.3f} {fine[both].mean():6.3f} {row['gain']:+7.4f}"
        print(text, flush=True)
        rows.append(row)
    if rows:
        print(f"{'mean ' + folder.name:28s} {'':11s} " + " ".join(f"{np.mean([r[k] for r in rows]):6.3f}" for k in KEYS)
              + f"   least AP50 {min(r['AP50'] for r in rows):.3f}\n")


def main():
    root = pathlib.Path(__file__).resolve().parents[2]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data", type=pathlib.Path)
    parser.add_argument("folders", nargs="*", default=["gravel", "outcrop", "sand"])
    parser.add_argument("--scree", default=str(root / "build/release/apps/scree"))
    parser.add_argument("--method", default="learned")
    parser.add_argument("--refinement", action="store_true")
    args = parser.parse_args()
    head = f"{'photograph':28s} truth found " + " ".join(f"{k:>6s}" for k in KEYS)
    print(head + ("  plain refined  gain" if args.refinement else ""))
    with tempfile.TemporaryDirectory() as scratch:
        for folder in args.folders:
            score(args, args.data / folder, scratch)


main()
