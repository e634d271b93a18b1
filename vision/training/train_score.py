#!/usr/bin/env python3
"""Train the network that scores candidate regions.

usage: train_score.py DATA TOOLS WORK --folds K [--fields DIR] [--table OUT.inc] [--keep] [--plain]

TOOLS is the folder of export_candidates and segment. A picture's candidates come from the edge
field of the fold that left it out: WORK/field_F_of_K.bin, by train_field.py, or with --fields the
finished planes DIR/<folder>_<stem>.f32 (float32: boundary, inside, distance; a picture without them
is left out). For each fold a
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
REGION_FEATURES = 42
OUTLINE_FEATURES = 14
COLUMNS = HEAD + REGION_FEATURES + OUTLINE_FEATURES
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
    """All regions of one picture with features and overlap, from a field that never saw it."""
    stem = stem_of(args, k, scale)
    if not args.keep:
        _, labels = prepare(args, item, k, scale)
        subprocess.run([os.path.join(args.tools, "export_candidates"), stem + ".raw", str(labels.shape[1]),
                        str(labels.shape[0]), field_of(args, item, fold), stem + ".labels", stem + ".candidates",
                        str(args.inside)], check=True)
    return np.fromfile(stem + ".candidates", np.float32).reshape(-1, COLUMNS)


def large(rows):
    return rows[:, HEAD] > np.log(LEAST_AREA) - 1e-6


def context(rows, score):
    """How every region stands among its fragments and wholes: vision/classical/region_context.cpp."""
    n, caution = len(rows), 0.38
    left, right, parent = (rows[:, c].astype(int) for c in (2, 3, 4))
    match, overlap = score[:, 0], score[:, 2]
    worth = np.maximum(0, 0.5 * (match + overlap) - caution)
    fragments, best, within, around = (np.zeros(n) for _ in range(4))
    for i in range(n):
        if left[i] >= 0:
            a, b = left[i], right[i]
            fragments[i] = best[a] + best[b]
            within[i] = max(within[a], within[b], match[a], match[b])
        best[i] = max(worth[i], fragments[i])
    for i in range(n - 1, -1, -1):
        if parent[i] >= 0:
            around[i] = max(around[parent[i]], worth[parent[i]] - fragments[parent[i]])
    has = parent >= 0
    other = np.where(left[parent] == np.arange(n), right[parent], left[parent])
    return np.stack([match, overlap, fragments, around, np.where(has, match[parent], 0),
                     np.where(has, match[other], 0), within], 1).astype(np.float32)


def fit(rows, columns, epochs, hidden, weight, seed):
    overlap = rows[:, :1]
    net = Network([len(columns), *hidden, 3], seed)
    net.train(rows[:, columns], np.concatenate([overlap > 0.5, overlap > 0.7, overlap], 1).astype(np.float32),
              np.repeat(weight[:, None], 3, 1), epochs, 4e-3, seed, batch=1024, decay=1e-3)
    return net


def weights(pictures):
    """Rows of pictures with few count for more: by the root of how many there are."""
    each = [np.full(len(r), len(r) ** -0.5, np.float32) for r in pictures]
    all_rows = np.concatenate(each)
    return all_rows / all_rows.mean()


def train(args, pictures):
    """The first network sees every region; the second those that pass it, with outline and context."""
    first = np.arange(HEAD, HEAD + REGION_FEATURES)
    seen = [rows[large(rows)] for rows in pictures]
    region = fit(np.concatenate(seen), first, args.epochs, (24, 16), weights(seen), args.seed)
    passed = []
    for rows in pictures:
        score = np.zeros((len(rows), 3))
        score[large(rows)] = region.predict(rows[large(rows)][:, first])
        passed.append(np.hstack([rows, context(rows, score)])[score[:, 0] > 0.05])
    rows = np.concatenate(passed)
    outline = [fit(rows, np.arange(HEAD, rows.shape[1]), 2 * args.epochs, (32, 16), weights(passed), args.seed + k)
               for k in range(args.networks)]
    return np.concatenate([np.float32([args.inside]), region.numbers(), *(net.numbers() for net in outline)])


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
    parser.add_argument("--epochs", type=int, default=40)
    parser.add_argument("--networks", type=int, default=2, help="networks that judge outlines; their mean counts")
    parser.add_argument("--seed", type=int, default=5)
    parser.add_argument("--fields", help="folder of finished edge fields")
    parser.add_argument("--inside", type=float, default=0.3, help="least inside value of a rock's pixel")
    parser.add_argument("--caution", type=float, default=0.38)
    parser.add_argument("--min-size", type=float, default=8)
    parser.add_argument("--plain", action="store_true", help="judge outlines before their refinement")
    parser.add_argument("--table")
    parser.add_argument("--keep", action="store_true", help="use the candidates exported before")
    args = parser.parse_args()
    items = [i for i in pictures(args.data) if not args.fields or os.path.exists(field_of(args, i, 0))]
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
                    f"{sum(int(large(r).sum()) for k in rows for r in rows[k])} candidates of {len(items)} labelled photographs."])

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
