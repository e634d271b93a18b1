"""Labelled photographs as crops for training: targets, augmentation, weights."""
import glob
import os
from dataclasses import dataclass

import cv2
import numpy as np
from scipy import ndimage as ndi

from outline_net import normalise
from things_over import put_thing

SIZE = 224
SCALES = (0.25, 2.2)       # of a crop
BORDER = 0.9               # px, spread of the boundary target at the crop's scale
FAR, FAR_WEIGHT = 4.0, 0.5  # ground farther than this from labels may hold unlabelled stones


@dataclass
class Picture:
    name: str
    fold: int
    rgb: list          # the photograph at 1, 1/2, 1/4
    edge: np.ndarray   # float32, px to the nearest border between rocks or rock and ground
    inside: np.ndarray
    distance: np.ndarray  # relative distance to the border
    weight: np.ndarray
    share: float = 1.0


def distances(labels):
    """Distance to the border in px (half a pixel beside it), and relative to the rock's greatest."""
    edge = cv2.distanceTransform((labels == 0).astype(np.uint8), cv2.DIST_L2, 5)
    relative = np.zeros(labels.shape, np.float32)
    for i, box in enumerate(ndi.find_objects(labels), 1):
        if box is None:
            continue
        # The picture's own edge is not a border of the rock.
        mine = labels[box] == i
        pads = [(int(s.start > 0), int(s.stop < n)) for s, n in zip(box, labels.shape)]
        d = cv2.distanceTransform(np.pad(mine, pads).astype(np.uint8), cv2.DIST_L2, 5)
        d = d[pads[0][0]:pads[0][0] + mine.shape[0], pads[1][0]:pads[1][0] + mine.shape[1]]
        d = np.where(np.isfinite(d) & (d < 1e6), d, max(mine.shape))
        edge[box][mine] = d[mine]
        relative[box][mine] = d[mine] / d.max()
    return np.maximum(edge - 0.5, 0).astype(np.float32), relative


def load(photo, labels, name, fold):
    rgb = np.ascontiguousarray(cv2.imread(photo)[..., ::-1])
    y = cv2.imread(labels, cv2.IMREAD_UNCHANGED).astype(np.int32)
    if rgb.shape[:2] != y.shape:
        raise SystemExit(f"{labels}: its size differs from that of {photo}")
    edge, relative = distances(y)
    weight = np.where((y == 0) & (edge > FAR), FAR_WEIGHT, 1).astype(np.float32)
    ignore = labels.replace("_labels.png", "_ignore.png")
    if os.path.exists(ignore):
        weight[cv2.imread(ignore, cv2.IMREAD_GRAYSCALE) > 127] = 0
    levels = [rgb]
    for _ in range(2):
        levels.append(cv2.resize(levels[-1], None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA))
    return Picture(name, fold, levels, edge, (y > 0).astype(np.float32), relative, weight)


def load_folders(folders, n_folds):
    """Pictures of every folder, dealt out to the folds in turn."""
    found = []
    for folder in folders:
        for k, labels in enumerate(sorted(glob.glob(os.path.join(folder, "*_labels.png")))):
            stem = labels[:-len("_labels.png")]
            name = f"{os.path.basename(os.path.normpath(folder))}/{os.path.basename(stem)}"
            found.append(load(sorted(glob.glob(stem + "_image.*"))[0], labels, name, k % n_folds))
    return found


def relight(x, rng):
    """Another light, another camera. x: float RGB in 0..1, or a little beyond."""
    h, w = x.shape[:2]
    x = np.clip(x, 0, 1) ** rng.uniform(0.6, 1.6) * rng.uniform(0.6, 1.4) + rng.uniform(-0.1, 0.1)
    x = x * rng.uniform(0.85, 1.15, (1, 1, 3)).astype(np.float32)
    if rng.random() < 0.3:  # less or no colour
        x = x + rng.uniform(0.5, 1) * (x.mean(2, keepdims=True) - x)
    if rng.random() < 0.3:  # a soft shadow over a part of it
        angle, at, soft = rng.uniform(0, 2 * np.pi), rng.uniform(-0.3, 0.3), rng.uniform(0.01, 0.3)
        yy, xx = np.mgrid[:h, :w].astype(np.float32)
        side = (np.cos(angle) * (xx / w - 0.5) + np.sin(angle) * (yy / h - 0.5) - at) / soft
        x = x * (1 - rng.uniform(0.2, 0.6) / (1 + np.exp(-np.clip(side, -30, 30))))[..., None]
    if rng.random() < 0.3:
        x = cv2.GaussianBlur(x, (0, 0), rng.uniform(0.4, 1.4))
    if rng.random() < 0.15:  # oversharpened, as small cameras do
        x = x + rng.uniform(0.3, 1.2) * (x - cv2.GaussianBlur(x, (0, 0), rng.uniform(0.7, 1.5)))
    x = x + rng.normal(0, 1, x.shape).astype(np.float32) * rng.uniform(0, 0.04)
    x = np.clip(x * 255, 0, 255).astype(np.uint8)
    if rng.random() < 0.25:
        x = cv2.imdecode(cv2.imencode(".jpg", x, [cv2.IMWRITE_JPEG_QUALITY, int(rng.uniform(25, 85))])[1], 1)
    return x


def crop(picture, rng, size=SIZE, things=0.0):
    """One turned, mirrored, stretched, relit crop -> input 3 x S x S, target 3 x S x S, weight S x S.

    things: how likely a hand, a scale card or the like lies over it.
    """
    h, w = picture.edge.shape
    scale = np.exp(rng.uniform(np.log(max(SCALES[0], 0.5 * size / max(h, w))), np.log(SCALES[1])))
    stretch = np.exp(rng.normal(0, 0.1))
    angle, flip = rng.uniform(0, 2 * np.pi), rng.choice([-1, 1])
    half = size / scale / 2
    cx = rng.uniform(min(half, w / 2), max(w - half, w / 2))
    cy = rng.uniform(min(half, h / 2), max(h - half, h / 2))
    turn = np.array([[np.cos(angle) * flip, -np.sin(angle)], [np.sin(angle) * flip, np.cos(angle)]])
    m = scale * turn @ np.diag([stretch, 1 / stretch])
    m = np.hstack([m, size / 2 - m @ np.array([[cx], [cy]])])
    level = min(len(picture.rgb) - 1, max(0, int(np.floor(-np.log2(scale)))))
    part = m.copy()  # from the halved picture: its pixel i lies at 2^level i + (2^level - 1) / 2
    part[:, 2] += m[:, :2] @ np.full(2, (2 ** level - 1) / 2)
    part[:, :2] *= 2 ** level
    border = {"borderMode": cv2.BORDER_REFLECT_101}
    x = cv2.warpAffine(picture.rgb[level], part, (size, size), flags=cv2.INTER_LINEAR, **border)
    planes = [cv2.warpAffine(v, m, (size, size), flags=cv2.INTER_LINEAR, **border)
              for v in (picture.edge, picture.inside, picture.distance, picture.weight)]
    x, planes[0] = x.astype(np.float32) / 255, planes[0] * scale
    if rng.random() < things:
        x, planes = put_thing(x, planes, rng, BORDER)
    boundary = np.exp(-planes[0] ** 2 / (2 * BORDER ** 2))
    x = normalise(relight(x, rng))
    return x.transpose(2, 0, 1), np.stack([boundary, *planes[1:3]]), planes[3]


def flow(distance):
    """Unit vectors up the relative distance, 2 x H x W: where from here the middle of the rock lies."""
    smooth = cv2.GaussianBlur(distance, (0, 0), 1.0)
    g = np.stack([cv2.Sobel(smooth, cv2.CV_32F, 1, 0), cv2.Sobel(smooth, cv2.CV_32F, 0, 1)])
    return g / (np.sqrt((g ** 2).sum(0)) + 1e-3)
