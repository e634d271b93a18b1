"""The network behind `--method learned`: its shape, its input, its fused field, its ONNX file."""
import io

import cv2
import numpy as np
import torch
import torch.nn as nn
import torch.nn.functional as F

from onnx_half import halved

CHANNELS = (32, 64, 128, 192, 224)
NAMES = ("boundary", "inside", "distance")
MULTIPLE = 2 ** len(CHANNELS)  # the sides of an input divide by this
CELL, BLUR, FLOOR = 8, 8, 0.04  # of normalise(): cell in px, blur in cells, least spread


def normalise(rgb):
    """8-bit RGB, sides divisible by CELL -> float32 of the same shape, free of the light's level.

    Every pixel loses the mean brightness of its surroundings, some 64 px wide, and is divided by
    the spread there. Nothing is measured over the whole picture, so a crop gives the same numbers.
    """
    x = rgb.astype(np.float32) / 255
    luma = x @ np.array([0.299, 0.587, 0.114], np.float32)
    size = (x.shape[1], x.shape[0])
    cells = (max(1, size[0] // CELL), max(1, size[1] // CELL))

    def around(v):
        small = cv2.resize(v, cells, interpolation=cv2.INTER_AREA)
        return cv2.GaussianBlur(small, (0, 0), BLUR, borderType=cv2.BORDER_REPLICATE)

    mean = around(luma)
    spread = np.sqrt(np.maximum(around(luma * luma) - mean * mean, 0))
    mean, spread = (cv2.resize(v, size, interpolation=cv2.INTER_LINEAR)[..., None] for v in (mean, spread))
    return (x - mean) / (spread + FLOOR)


def block(c_in, c_out, size=3, stride=1, padding=1):
    return nn.Sequential(nn.Conv2d(c_in, c_out, size, stride, padding, bias=False), nn.BatchNorm2d(c_out),
                         nn.ReLU(inplace=True))


class OutlineNet(nn.Module):
    """A U-Net whose first level already has half the picture's resolution.

    At full resolution lies only the input; the head says four pixels at once. That keeps most
    channels where pixels are few, which is what a processor without a GPU is short of. Levels are
    joined by addition: joined side by side, the same network takes two fifths longer.
    """

    def __init__(self, channels=CHANNELS, n_outputs=len(NAMES)):
        super().__init__()
        c, last = channels, len(channels) - 1
        self.stem = block(3, c[0], 4, 2, 1)
        self.down = nn.ModuleList(
            [block(c[0], c[0])] + [nn.Sequential(block(a, b), block(b, b)) for a, b in zip(c, c[1:])])
        self.narrow = nn.ModuleList([nn.Conv2d(c[i], c[i - 1], 1) for i in range(last, 0, -1)])
        self.up = nn.ModuleList([block(c[i - 1], c[i - 1]) for i in range(last, 0, -1)])
        self.head = nn.Conv2d(c[0], 4 * n_outputs, 3, 1, 1)

    def forward(self, x):
        """N x 3 x H x W, normalised -> logits, N x 4K x H/2 x W/2."""
        x, kept = self.stem(x), []
        for i, level in enumerate(self.down):
            x = level(F.max_pool2d(x, 2) if i else x)
            kept.append(x)
        kept.pop()
        for narrow, up in zip(self.narrow, self.up):
            x = F.interpolate(narrow(x), scale_factor=2.0, mode="nearest")
            x = up(F.relu(x + kept.pop()))
        return self.head(x)


def unfold(folded):
    """Logits as the network gives them -> N x K x H x W."""
    return F.pixel_shuffle(folded, 2)


def logits_of(net, rgb, flips=False):
    """8-bit RGB -> K x H x W logits of one level; with `flips` the mean over mirror images."""
    h, w = rgb.shape[:2]
    mode = cv2.BORDER_REFLECT_101 if min(h, w) > MULTIPLE else cv2.BORDER_REPLICATE
    x = normalise(cv2.copyMakeBorder(rgb, 0, -h % MULTIPLE, 0, -w % MULTIPLE, mode))
    x = torch.from_numpy(np.ascontiguousarray(x.transpose(2, 0, 1)[None])).contiguous(memory_format=torch.channels_last)
    views = [(), (3,), (2,), (2, 3)] if flips else [()]
    with torch.no_grad(), torch.autocast("cpu", dtype=torch.bfloat16, enabled=False):
        total = sum(torch.flip(unfold(net(torch.flip(x, v))).float(), v) for v in views) / len(views)
    return total[0, :, :h, :w].numpy()


def levels_of(rgb, scales):
    """[(scale, picture)] by area for smaller, cubic for larger ones."""
    for s in scales:
        size = (max(1, round(rgb.shape[1] * s)), max(1, round(rgb.shape[0] * s)))
        mode = cv2.INTER_AREA if s < 1 else cv2.INTER_CUBIC
        yield s, rgb if s == 1 else cv2.resize(rgb, size, interpolation=mode)


def field_of(net, rgb, scales=(1.0, 0.5, 0.25), flips=False):
    """8-bit RGB -> K x H x W probabilities: the mean of the levels' logits."""
    size = (rgb.shape[1], rgb.shape[0])
    total = 0
    for s, level in levels_of(rgb, scales):
        raw = logits_of(net, np.ascontiguousarray(level), flips)
        total = total + np.stack([v if s == 1 else cv2.resize(v, size, interpolation=cv2.INTER_AREA if s > 1 else
                                                              cv2.INTER_LINEAR) for v in raw])
    return 1 / (1 + np.exp(-total / len(scales)))


def folded_norms(net):
    """A copy without batch norms: each is folded into the convolution before it."""
    from torch.nn.utils.fusion import fuse_conv_bn_eval
    copy = type(net).__new__(type(net))
    copy.__dict__ = {**net.__dict__, "_modules": dict(net._modules)}

    def walk(module):
        if isinstance(module, nn.Sequential) and len(module) and isinstance(module[0], nn.Conv2d):
            return nn.Sequential(fuse_conv_bn_eval(module[0], module[1]), nn.ReLU())
        if isinstance(module, (nn.Sequential, nn.ModuleList)):
            return type(module)(*[walk(m) for m in module]) if isinstance(module, nn.Sequential) else \
                nn.ModuleList([walk(m) for m in module])
        return module

    copy._modules = {k: walk(m) for k, m in net._modules.items()}
    return copy.eval()


def write_onnx(net, path, side=256):
    """The network as the library reads it: norms folded in, the head unfolded there, weights halved."""
    net = folded_norms(net.eval())
    file = io.BytesIO()
    torch.onnx.export(net, torch.zeros(1, 3, side, side), file, opset_version=11, input_names=["picture"],
                      output_names=["field"])
    with open(path, "wb") as out:
        out.write(halved(file.getvalue()))
