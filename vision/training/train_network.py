#!/usr/bin/python3
"""Train the network of `--method learned` on folders of labelled photographs.

usage: train_network.py OUT FOLDER... [--steps N | --minutes M] [--folds K --fold F] [--seed S]
                        [--extra FOLDER...] [--start WEIGHTS.pt]

A FOLDER holds *_image.* beside *_labels.png (16 bit, 0 = ground) and perhaps *_ignore.png (255 =
says nothing). With --fold the pictures of that fold are left out, and their fields are written
beside the weights as OUT/<folder>_<picture>.f32. Pictures of --extra (synthetic ones) are never
left out. Written: OUT/weights.pt, OUT/network.onnx, OUT/card.md, OUT/log.txt.
"""
import argparse
import os
import queue
import sys
import threading
import time

import cv2
import numpy as np
import torch
import torch.nn.functional as F

from model_card import write_card
from outline_data import crop, flow, load_folders
from outline_net import CHANNELS, NAMES, OutlineNet, field_of, unfold, write_onnx

BATCH, RATE, DECAY = 4, 3e-3, 1e-4


def loss_of(raw, want, weight, args):
    p = torch.sigmoid(raw)
    edge = 1 + args.border_weight * want[:, 0]
    total = (F.binary_cross_entropy_with_logits(raw[:, 0], want[:, 0], reduction="none") * weight * edge).mean()
    total = total + (F.binary_cross_entropy_with_logits(raw[:, 1], want[:, 1], reduction="none") * weight * edge).mean()
    total = total + 2 * (F.smooth_l1_loss(p[:, 2], want[:, 2], beta=0.1, reduction="none") * weight).mean()
    for c in (0, 1):
        both, sums = (p[:, c] * want[:, c] * weight).sum(), ((p[:, c] ** 2 + want[:, c] ** 2) * weight).sum()
        total = total + 0.5 * (1 - (2 * both + 1) / (sums + 1))
    if raw.shape[1] > len(NAMES):  # a flow head, learned beside the others and never used
        along = F.smooth_l1_loss(torch.tanh(raw[:, 3:5]), want[:, 3:5], beta=0.1, reduction="none")
        total = total + (along * (want[:, 1] * weight)[:, None]).mean()
    return total


def batches(pictures, chances, args):
    """An endless supply; a batch depends on its number and the seed alone."""
    ready = queue.Queue(6)

    def work():
        for k in range(1 << 40):
            rng = np.random.default_rng([args.seed, k])
            made = [crop(pictures[i], rng, things=args.things) for i in rng.choice(len(pictures), args.batch, p=chances)]
            if args.flow:
                made = [(x, np.concatenate([want, flow(want[2])]), weight) for x, want, weight in made]
            ready.put([torch.from_numpy(np.ascontiguousarray(np.stack(v), np.float32)) for v in zip(*made)])

    threading.Thread(target=work, daemon=True).start()
    while True:
        yield ready.get()


def chances_of(pictures, extra_share):
    """Real pictures by the fourth root of their area, the extra ones sharing `extra_share` equally."""
    extra = np.array([p.fold < 0 for p in pictures])
    c = np.array([p.edge.size for p in pictures], float) ** 0.25
    if extra.any() and not extra.all():
        c[extra] *= extra_share / c[extra].sum()
        c[~extra] *= (1 - extra_share) / c[~extra].sum()
    return c / c.sum()


def train(pictures, args, say):
    torch.manual_seed(args.seed)
    net = OutlineNet(args.channels, len(NAMES) + 2 * args.flow).to(memory_format=torch.channels_last)
    if args.start:
        net.load_state_dict(torch.load(args.start))
    slow = {k: v.clone() for k, v in net.state_dict().items()}  # running mean of the weights
    opt = torch.optim.AdamW(net.parameters(), args.rate, weight_decay=DECAY)
    start, step, mean = time.time(), 0, None
    for x, want, weight in batches(pictures, chances_of(pictures, args.extra_share), args):
        part = step / args.steps if args.steps else (time.time() - start) / (args.minutes * 60)
        if part >= 1:
            break
        for g in opt.param_groups:
            g["lr"] = args.rate * min(1, step / 100 + 0.01) * (0.5 + 0.5 * np.cos(np.pi * part))
        with torch.autocast("cpu", dtype=torch.bfloat16, enabled=args.half):
            raw = net(x.contiguous(memory_format=torch.channels_last))
        loss = loss_of(unfold(raw.float()), want, weight, args)
        opt.zero_grad(set_to_none=True)
        loss.backward()
        torch.nn.utils.clip_grad_norm_(net.parameters(), 2.0)
        opt.step()
        step += 1
        keep = min(0.998, step / (step + 10))
        for k, v in net.state_dict().items():
            slow[k] = keep * slow[k] + (1 - keep) * v if v.dtype.is_floating_point else v
        mean = loss.item() if mean is None else 0.98 * mean + 0.02 * loss.item()
        if step % 100 == 0:
            say(f"step {step} loss {mean:.4f} {time.time() - start:.0f} s")
            torch.save(slow, os.path.join(args.out, "weights.pt"))
    net.load_state_dict(slow)
    return net.eval(), step, time.time() - start


def arguments():
    a = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    a.add_argument("out")
    a.add_argument("folders", nargs="+")
    a.add_argument("--extra", nargs="*", default=[])
    a.add_argument("--extra-share", type=float, default=0.3)
    a.add_argument("--steps", type=int, default=0)
    a.add_argument("--minutes", type=float, default=30)
    a.add_argument("--folds", type=int, default=4)
    a.add_argument("--fold", type=lambda t: set(map(int, t.split(","))), default=set(), help="left out; several with commas")
    a.add_argument("--seed", type=int, default=0)
    a.add_argument("--licence", nargs="*", default=[], metavar="FOLDER=TEXT", help="for the model card")
    a.add_argument("--start")
    a.add_argument("--rate", type=float, default=RATE)
    a.add_argument("--batch", type=int, default=BATCH)
    a.add_argument("--border-weight", type=float, default=1.0, help="pixels at a border count 1 + this")
    a.add_argument("--things", type=float, default=0.0, help="share of crops with a hand, scale card or the like over them")
    a.add_argument("--flow", action="store_true", help="learn the way to the middle beside the distance")
    a.add_argument("--channels", type=lambda t: tuple(map(int, t.split(","))), default=CHANNELS)
    a.add_argument("--threads", type=int, default=os.cpu_count())
    a.add_argument("--half", action=argparse.BooleanOptionalAction, default=True, help="train in bfloat16")
    return a.parse_args()


def main():
    args = arguments()
    torch.set_num_threads(args.threads)
    cv2.setNumThreads(1)
    os.makedirs(args.out, exist_ok=True)
    log = open(os.path.join(args.out, "log.txt"), "w")

    def say(text):
        print(text, flush=True)
        print(text, file=log, flush=True)

    say(" ".join(sys.argv[1:]))
    real = load_folders(args.folders, args.folds)
    extra = load_folders(args.extra, 1)
    for p in extra:
        p.fold = -1
    net, steps, seconds = train([p for p in real if p.fold not in args.fold] + extra, args, say)
    torch.save(net.state_dict(), os.path.join(args.out, "weights.pt"))
    write_onnx(net, os.path.join(args.out, "network.onnx"))
    write_card(os.path.join(args.out, "card.md"), args, real, extra, seconds, steps, net)
    for p in real:
        if p.fold in args.fold:
            field_of(net, p.rgb[0])[:len(NAMES)].astype(np.float32).tofile(
                os.path.join(args.out, p.name.replace("/", "_") + ".f32"))


if __name__ == "__main__":
    main()
