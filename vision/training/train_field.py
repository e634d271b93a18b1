#!/usr/bin/env python3
"""Train the networks of the classical edge field.

usage: train_field.py DATA EXPORT_SAMPLES WORK --folds K [--fold F] [--views V] [--table OUT.inc]

Each of the K folds leaves every K-th picture of every folder out; the model lands in
WORK/field_F_of_K.bin. Without --fold all pictures are used: WORK/field_all.bin, and the table.
The coarsest level is trained first, then each finer one on what the coarser ones say.
"""
import argparse
import os
import subprocess
import tempfile

import cv2
import numpy as np

from common import Network, fold_of, pictures, read_pair, write_table

LEVELS = 5
HIDDEN = {4: (40, 24), 3: (48, 32), 2: (48, 32), 1: (40, 24), 0: (32, 16)}
SAMPLES = {4: 2500, 3: 4500, 2: 6000, 1: 6000, 0: 6000}


def view_of(photo, labels, rng, plain):
    """A picture seen anew: turned, scaled, in other light."""
    if plain:
        return np.ascontiguousarray(photo), labels
    scale = float(np.exp(rng.uniform(np.log(0.55), np.log(1.5))))
    size = (max(64, round(photo.shape[1] * scale)), max(64, round(photo.shape[0] * scale)))
    photo = cv2.resize(np.ascontiguousarray(photo), size, interpolation=cv2.INTER_AREA if scale < 1 else cv2.INTER_CUBIC)
    labels = cv2.resize(labels, size, interpolation=cv2.INTER_NEAREST)
    turns = rng.integers(4)
    photo, labels = np.rot90(photo, turns), np.rot90(labels, turns)
    if rng.random() < 0.5:
        photo, labels = photo[:, ::-1], labels[:, ::-1]
    light = np.exp(rng.normal(0, 0.08, 3) + rng.normal(0, 0.1)) 
    photo = 255 * np.clip(photo / 255 * light, 0, 1) ** np.exp(rng.normal(0, 0.2))
    grey = photo.mean(2, keepdims=True)
    photo = grey + (photo - grey) * rng.uniform(0.5, 1.2)
    return np.ascontiguousarray(np.clip(photo, 0, 255).astype(np.uint8)), np.ascontiguousarray(labels)


def border_distance(labels):
    """Distance to the nearest border between labels, and the same relative to a rock's deepest point."""
    edge = np.zeros(labels.shape, bool)
    for a, b in ((np.s_[1:, :], np.s_[:-1, :]), (np.s_[:, 1:], np.s_[:, :-1])):
        differs = labels[a] != labels[b]
        edge[a] |= differs
        edge[b] |= differs
    away = cv2.distanceTransform((~edge).astype(np.uint8), cv2.DIST_L2, 5)
    order = np.argsort(away, axis=None)
    deepest = np.ones(int(labels.max()) + 1, np.float32)
    deepest[labels.ravel()[order]] = away.ravel()[order] + 1  # the last, the largest, stays
    relative = np.where(labels > 0, (away + 0.5) / np.maximum(deepest[labels], 1), 0)
    return away, relative.astype(np.float32)


def targets(labels, away, relative, level):
    """Boundary, inside, relative distance at a level, the weight of each, and the border's distance."""
    size = 1 << level
    h, w = labels.shape[0] // size, labels.shape[1] // size

    def down(a):
        a = a[:h * size, :w * size].astype(np.float32)
        return cv2.resize(a, (w, h), interpolation=cv2.INTER_AREA)

    near = down(away) / size
    boundary = np.exp(-np.maximum(near - (0.0 if level == 0 else 0.25), 0) ** 2 / (2 * 0.8 ** 2))
    inside = down(labels > 0)
    # Small rocks in the gaps often carry no label: what looks like a border there may be one.
    unsure = (inside < 0.01) & (near > 2)
    weight = np.stack([np.where(unsure, 0.3, 1.0), np.where(unsure, 0.5, 1.0), np.where(unsure, 0.5, 1.0)], -1)
    return np.stack([boundary, inside, down(relative)], -1), weight, near


def choose(near, n, rng):
    flat = near.ravel()
    close = np.flatnonzero(flat < 1.2)
    some = rng.integers(0, flat.size, n - n // 4)
    pick = np.concatenate([some, rng.choice(close, n // 4)]) if len(close) else some
    return np.stack([pick % near.shape[1], pick // near.shape[1]], -1).astype(np.int32)


class Views:
    """The pictures seen anew, kept as files so that every level reads the same ones."""

    def __init__(self, args, items, rng):
        self.folder = tempfile.TemporaryDirectory(dir=args.work)
        self.shapes = []
        for photo_file, labels_file in (i[2:4] for i in items):
            pair = read_pair(photo_file, labels_file)
            for v in range(args.views):
                photo, labels = view_of(*pair, rng, v == 0)
                stem = self.stem(len(self.shapes))
                photo.tofile(stem + ".raw")
                np.savez(stem, labels, *border_distance(labels))
                self.shapes.append(photo.shape)

    def stem(self, k):
        return os.path.join(self.folder.name, str(k))

    def samples(self, args, level, coarser, rng):
        model, positions, out = (os.path.join(self.folder.name, n) for n in ("model", "positions", "out"))
        (np.concatenate(coarser) if coarser else np.zeros(0, np.float32)).tofile(model)
        xs, ys, ws = [], [], []
        for k, shape in enumerate(self.shapes):
            y, w, near = targets(*np.load(self.stem(k) + ".npz").values(), level)
            where = choose(near, SAMPLES[level], rng)
            where.tofile(positions)
            subprocess.run([args.exporter, self.stem(k) + ".raw", str(shape[1]), str(shape[0]), str(level),
                            model, positions, out], check=True)
            xs.append(np.fromfile(out, np.float32).reshape(len(where), -1))
            ys.append(y[where[:, 1], where[:, 0]])
            ws.append(w[where[:, 1], where[:, 0]])
        return (np.concatenate(a).astype(np.float32) for a in (xs, ys, ws))


def train(args, items, seed):
    rng = np.random.default_rng(seed)
    models = {}
    views = Views(args, items, rng)
    for level in range(LEVELS - 1, -1, -1):
        x, y, w = views.samples(args, level, [models[k] for k in range(level + 1, LEVELS)], rng)
        net = Network([x.shape[1], *HIDDEN[level], 3], seed + level)
        loss = net.train(x, y, w, args.epochs, 3e-3, seed + level)
        models[level] = net.numbers()
        print(f"level {level}: {len(x)} samples of {x.shape[1]} values, loss {loss:.4f}", flush=True)
    return np.concatenate([models[k] for k in range(LEVELS)])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data")
    parser.add_argument("exporter")
    parser.add_argument("work")
    parser.add_argument("--folds", type=int, default=6)
    parser.add_argument("--fold", type=int)
    parser.add_argument("--views", type=int, default=4)
    parser.add_argument("--epochs", type=int, default=15)
    parser.add_argument("--table")
    args = parser.parse_args()
    items = pictures(args.data)
    folds = fold_of(items, args.folds)
    chosen = [i for i, f in zip(items, folds) if f != args.fold]
    numbers = train(args, chosen, 1)
    name = "field_all" if args.fold is None else f"field_{args.fold}_of_{args.folds}"
    numbers.tofile(os.path.join(args.work, name + ".bin"))
    if args.table:
        write_table(args.table, numbers, ["Written by vision/training/train_field.py; do not edit.",
                    f"{len(chosen)} labelled photographs, {args.views} views each, {args.epochs} epochs."])


if __name__ == "__main__":
    main()
