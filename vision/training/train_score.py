#!/usr/bin/env python3
"""Train the network that scores candidate regions.

usage: train_score.py DATA TOOLS WORK --folds K [--fields DIR] [--table OUT.inc] [--keep] [--plain]

TOOLS is the folder of export_candidates and segment. A picture's candidates come from the edge
field of the fold that left it out: WORK/field_F_of_K.bin, by train_field.py, or with --fields the
finished planes DIR/<folder>_<stem>.f32 (float32: boundary, inside, distance). For each fold a
score is trained on the other pictures (WORK/score_F_of_K.bin) and the left-out pictures are
segmented with both and scored; then one on all pictures is written: WORK/score_all.bin, the table.
"""
import argparse
import os
import subprocess
from concurrent.futures import ThreadPoolExecutor

import cv2
import numpy as np

from common import Network, fold_of, pictures, read_pair, score, write_table

HEAD = 5          # overlap, label, left, right, parent
REGION_FEATURES = 30
LEAST_AREA = 35   # pixels
SCALES = (1.0,)


def stem_of(args, k, scale):
    return os.path.join(args.work, f"p{k}_{scale:g}")


def prepare(args, item, k, scale):
    photo, labels = read_pair(item[2], item[3])
    if scale != 1:
        size = (round(photo.shape[1] * scale), round(photo.shape[0] * scale))
        photo = cv2.resize(np.ascontiguousarray(photo), size, interpolation=cv2.INTER_AREA if scale < 1 else cv2.INTER_CUBIC)
        labels = cv2.resize(labels, size, interpolation=cv2.INTER_NEAREST)
    stem = stem_of(args, k, scale)
    np.ascontiguousarray(photo).tofile(stem + ".raw")
    labels.astype(np.uint16).tofile(stem + ".labels")
    return stem, labels


def field_of(args, item, fold):
    """The edge field that never saw the picture: finished planes, or networks that make it."""
    if args.fields:
        return os.path.join(args.fields, item[0].replace("/", "_") + ".f32")
    return os.path.join(args.work, f"field_{fold}_of_{args.folds}.bin")


def candidates(args, item, k, fold, scale):
    """Features and overlap of the candidates of one picture, seen by the fold that never saw it."""
    stem = stem_of(args, k, scale)
    if not args.keep:
        _, labels = prepare(args, item, k, scale)
        subprocess.run([os.path.join(args.tools, "export_candidates"), stem + ".raw", str(labels.shape[1]),
                        str(labels.shape[0]), field_of(args, item, fold), stem + ".labels", stem + ".candidates"], check=True)
    rows = np.fromfile(stem + ".candidates", np.float32).reshape(-1, args.columns)
    return rows[rows[:, HEAD] > np.log(LEAST_AREA)]


def fit(rows, columns, epochs, hidden):
    overlap = rows[:, :1]
    net = Network([len(columns), *hidden, 3], 5)
    net.train(rows[:, columns], np.concatenate([overlap > 0.5, overlap > 0.7, overlap], 1).astype(np.float32),
              np.ones((len(rows), 3), np.float32), epochs, 4e-3, 5, batch=1024)
    return net


def train(args, rows):
    """The first network sees every region, the second those that pass it, with their outlines."""
    rows = np.concatenate(rows)
    first = np.arange(HEAD, HEAD + REGION_FEATURES)
    region = fit(rows, first, args.epochs, (24, 16))
    passed = region.predict(rows[:, first])[:, 0] > 0.05
    outline = fit(rows[passed], np.arange(HEAD, rows.shape[1]), 2 * args.epochs, (32, 16))
    return np.concatenate([region.numbers(), outline.numbers()])


def judge(args, item, k, field, score_file):
    _, labels = read_pair(item[2], item[3])
    stem = stem_of(args, k, 1.0)
    subprocess.run([os.path.join(args.tools, "segment"), stem + ".raw", str(labels.shape[1]), str(labels.shape[0]),
                    field, score_file, stem + ".segmented", str(args.caution), str(args.min_size),
                    *(["plain"] if args.plain else [])], check=True)
    found = np.fromfile(stem + ".segmented", np.uint16).reshape(labels.shape)
    return score(found.astype(np.int64), labels.astype(np.int64))


def report(title, items, results):
    print(title)
    keys = ("AP50", "AP75", "F1", "IoU", "cover", "D50err", "D84err")
    print(f"{'picture':36s} truth found " + " ".join(f"{k:>6s}" for k in keys))
    for item, r in zip(items, results):
        print(f"{item[0]:36s} {r['truth']:5d} {r['pred']:5d} " + " ".join(f"{r[k]:6.3f}" for k in keys))
    for folder in sorted({i[1] for i in items}):
        mine = [r for i, r in zip(items, results) if i[1] == folder]
        name = "mean " + next(i[0] for i in items if i[1] == folder).split("/")[0]
        print(f"{name:48s} " + " ".join(f"{np.mean([r[k] for r in mine]):6.3f}" for k in keys), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data")
    parser.add_argument("tools")
    parser.add_argument("work")
    parser.add_argument("--folds", type=int, default=6)
    parser.add_argument("--epochs", type=int, default=10)
    parser.add_argument("--columns", type=int, default=49)
    parser.add_argument("--fields", help="folder of finished edge fields")
    parser.add_argument("--caution", type=float, default=0.38)
    parser.add_argument("--min-size", type=float, default=8)
    parser.add_argument("--plain", action="store_true", help="judge outlines before their refinement")
    parser.add_argument("--table")
    parser.add_argument("--keep", action="store_true", help="use the candidates exported before")
    args = parser.parse_args()
    items = pictures(args.data)
    folds = fold_of(items, args.folds)
    pool = ThreadPoolExecutor(2)
    rows = {}
    for scale in SCALES:
        found = pool.map(lambda k: candidates(args, items[k], k, folds[k], scale), range(len(items)))
        for k, r in enumerate(found):
            rows.setdefault(k, []).append(r)
    for f in range(args.folds):
        train(args, [r for k in rows if folds[k] != f for r in rows[k]]).tofile(
            os.path.join(args.work, f"score_{f}_of_{args.folds}.bin"))
    numbers = train(args, [r for k in rows for r in rows[k]])
    numbers.tofile(os.path.join(args.work, "score_all.bin"))
    if args.table:
        write_table(args.table, numbers, ["Written by vision/training/train_score.py; do not edit.",
                    f"{sum(len(r) for k in rows for r in rows[k])} candidates of {len(items)} labelled photographs."])

    def left_out(k):
        score_file = os.path.join(args.work, f"score_{folds[k]}_of_{args.folds}.bin")
        return judge(args, items[k], k, field_of(args, items[k], folds[k]), score_file)

    report("left out (field and score never saw the picture)", items, list(pool.map(left_out, range(len(items)))))
    all_field, all_score = (os.path.join(args.work, n) for n in ("field_all.bin", "score_all.bin"))
    if os.path.exists(all_field):
        report("resubstitution (trained on the same pictures)", items, list(pool.map(
            lambda k: judge(args, items[k], k, all_field, all_score), range(len(items)))))


if __name__ == "__main__":
    main()
