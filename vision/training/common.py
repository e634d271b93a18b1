"""Shared by the training scripts: pictures with labels, folds by picture, a small network in numpy."""
import glob
import os

import cv2
import numpy as np


def pictures(data, folders=("gravel", "outcrop", "sand")):
    """[(name, folder index, photo path, labels path)], sorted, so that folds are always the same."""
    found = []
    for index, folder in enumerate(folders):
        for labels in sorted(glob.glob(os.path.join(data, folder, "*_labels.png"))):
            stem = labels[: -len("_labels.png")]
            photo = next(p for p in sorted(glob.glob(stem + "_image.*")))
            found.append((f"{folder}/{os.path.basename(stem)}", index, photo, labels))
    return found


def fold_of(items, n_folds):
    """Fold of each picture: the pictures of every folder are dealt out in turn."""
    seen, folds = {}, []
    for _, folder, _, _ in items:
        folds.append(seen.get(folder, 0) % n_folds)
        seen[folder] = seen.get(folder, 0) + 1
    return folds


class Network:
    """Fully connected, rectified hidden layers, logistic outputs, cross-entropy, Adam."""

    def __init__(self, sizes, seed):
        rng = np.random.default_rng(seed)
        self.w = [rng.normal(0, np.sqrt(2 / a), (a, b)).astype(np.float32) for a, b in zip(sizes, sizes[1:])]
        self.b = [np.zeros(b, np.float32) for b in sizes[1:]]

    def forward(self, x):
        kept = [x]
        for i, (w, b) in enumerate(zip(self.w, self.b)):
            x = x @ w + b
            if i + 1 < len(self.w):
                np.maximum(x, 0, out=x)
                kept.append(x)
        return kept, 1 / (1 + np.exp(-x))

    def train(self, x, y, weight, epochs, rate, seed, batch=2048, decay=1e-5):
        self.mean, self.std = x.mean(0), x.std(0) + 1e-4
        x = np.clip((x - self.mean) / self.std, -6, 6).astype(np.float32)
        rng = np.random.default_rng(seed)
        params = self.w + self.b
        m, v = [np.zeros_like(p) for p in params], [np.zeros_like(p) for p in params]
        steps, t = epochs * (len(x) // batch), 0
        for _ in range(epochs):
            order, losses = rng.permutation(len(x)), []
            for k in range(len(x) // batch):
                pick = order[k * batch:(k + 1) * batch]
                kept, p = self.forward(x[pick])
                losses.append(float(np.mean(weight[pick] * -(y[pick] * np.log(p + 1e-7) + (1 - y[pick]) * np.log(1 - p + 1e-7)))))
                g = (p - y[pick]) * weight[pick] / batch
                grad_w, grad_b = [], []
                for i in range(len(self.w) - 1, -1, -1):
                    grad_w.insert(0, kept[i].T @ g + decay * self.w[i])
                    grad_b.insert(0, g.sum(0))
                    if i:
                        g = (g @ self.w[i].T) * (kept[i] > 0)
                t += 1
                lr = rate * min(1, t / 100) * (0.5 + 0.5 * np.cos(np.pi * t / steps))
                for j, g_j in enumerate(grad_w + grad_b):
                    m[j] += 0.1 * (g_j - m[j])
                    v[j] += 0.001 * (g_j * g_j - v[j])
                    params[j] -= lr * (m[j] / (1 - 0.9 ** t)) / (np.sqrt(v[j] / (1 - 0.999 ** t)) + 1e-8)
        return float(np.mean(losses))

    def predict(self, x):
        return self.forward(np.clip((x - self.mean) / self.std, -6, 6).astype(np.float32))[1]

    def numbers(self):
        """Flat table for the C++ side, the standardisation of the inputs folded into the first layer."""
        out = [len(self.w)]
        for i, (w, b) in enumerate(zip(self.w, self.b)):
            if i == 0:
                b = b - (self.mean / self.std) @ w
                w = w / self.std[:, None]
            out += [w.shape[0], w.shape[1], *w.T.ravel(), *b]
        return np.array(out, np.float32)


def write_table(path, numbers, how):
    """A table of numbers to be included by a C++ source."""
    text = [f"// {line}" for line in how]
    words = [f"{v:.4g}" for v in numbers]
    text += [",".join(words[i:i + 16]) + "," for i in range(0, len(words), 16)]
    with open(path, "w") as out:
        out.write("\n".join(text) + "\n")


def read_pair(photo, labels):
    return cv2.imread(photo)[..., ::-1], cv2.imread(labels, cv2.IMREAD_UNCHANGED)


def relabel(a):
    _, inv = np.unique(np.concatenate([[0], a.ravel()]), return_inverse=True)
    return inv[1:].reshape(a.shape)


def score(found, truth):
    """Overlap figures of a label map against the truth; a match is an overlap over one half."""
    p, t = relabel(found), relabel(truth)
    n_p, n_t = int(p.max()), int(t.max())
    both = np.bincount(p.ravel() * (n_t + 1) + t.ravel(), minlength=(n_p + 1) * (n_t + 1)).reshape(n_p + 1, n_t + 1).astype(float)
    area_p, area_t = both.sum(1)[1:], both.sum(0)[1:]
    overlap = both[1:, 1:] / np.maximum(area_p[:, None] + area_t[None] - both[1:, 1:], 1)
    result = {"truth": n_t, "pred": n_p}
    for name, least in (("AP50", 0.5), ("AP75", 0.75)):
        hits = int((overlap > least).sum())
        result[name] = hits / max(1, n_p + n_t - hits)
    hits = overlap > 0.5
    result["F1"] = 2 * int(hits.sum()) / max(1, n_p + n_t)
    result["IoU"] = float(overlap[hits].mean()) if hits.any() else 0.0
    result["cover"] = float(((p > 0) & (t > 0)).sum() / max(1, ((p > 0) | (t > 0)).sum()))
    for name, q in (("D50err", 50), ("D84err", 84)):
        d_t = np.percentile(np.sqrt(area_t), q)
        result[name] = abs(np.percentile(np.sqrt(area_p), q) - d_t) / d_t if n_p else 1.0
    return result
