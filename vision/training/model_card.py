"""What a trained network is made of, as a page of Markdown."""
import hashlib
import json
import os


def write_card(path, args, real, extra, seconds, steps, net):
    """Data, how it was trained, and the figures by fold where OUT/../folds.json has them."""
    folders = {}
    for p in real:
        folders.setdefault(os.path.dirname(p.name), []).append(os.path.basename(p.name))
    lines = ["# Model card: outline network", "",
             "Fills an edge field (boundary, inside, relative distance to the border) from a photograph of rocks.", "",
             "## Data", "", "| folder | pictures | megapixels | licence |", "|---|---|---|---|"]
    licences = dict(item.split("=", 1) for item in args.licence)
    for folder, names in folders.items():
        size = sum(p.edge.size for p in real if p.name.startswith(folder + "/")) / 1e6
        lines.append(f"| {folder} | {len(names)} | {size:.1f} | {licences.get(folder, 'not stated')} |")
    if extra:
        lines.append(f"| synthetic | {len(extra)} | {sum(p.edge.size for p in extra) / 1e6:.1f} | this project's own |")
    left_out = [p.name for p in real if p.fold in args.fold]
    lines += ["", f"Left out: {', '.join(left_out) if left_out else 'none, trained on all of them'}.", "", "## Training", "",
              f"- {sum(v.numel() for v in net.parameters()):,} weights, channels {', '.join(map(str, args.channels))}",
              f"- {steps} steps of {args.batch} crops, seed {args.seed}, rate {args.rate:g}, border weight {args.border_weight:g}, "
              f"share of synthetic crops {args.extra_share if extra else 0:g}, with things over them {args.things:g}",
              f"- {seconds / 60:.0f} minutes on {args.threads} thread(s)"]
    figures = os.path.join(os.path.dirname(os.path.abspath(args.out)), "folds.json")
    if os.path.exists(figures):
        with open(figures) as file:
            rows = json.load(file)
        lines += ["", "## By folds of pictures", "", "Plain watershed of the field, picture never seen in training.", "",
                  "| picture | AP50 | IoU | D50 error | D84 error |", "|---|---|---|---|---|"]
        lines += [f"| {r['name']} | {r['AP50']:.3f} | {r['IoU']:.3f} | {r['D50err']:.3f} | {r['D84err']:.3f} |" for r in rows]
    with open(os.path.join(args.out, "network.onnx"), "rb") as file:
        lines += ["", f"SHA-256 of the file: `{hashlib.sha256(file.read()).hexdigest()}`"]
    with open(path, "w") as out:
        out.write("\n".join(lines) + "\n")
