"""Hands, scale cards, rulers, coins, pens and shells over a crop: what lies among stones and is none."""
import cv2
import numpy as np

SKIN = np.float32([[0.90, 0.72, 0.62], [0.80, 0.58, 0.45], [0.62, 0.42, 0.30], [0.40, 0.26, 0.18], [0.25, 0.16, 0.12]])
#          base x, y, towards x, y, length, width at either end; in finger's half widths, the palm in the middle
FINGERS = ((-2.5, -2.8, -0.30, -1.0, 5.0, 0.95, 0.75), (-0.85, -3.4, -0.08, -1.0, 6.4, 1.0, 0.8),
           (0.85, -3.4, 0.10, -1.0, 7.0, 1.0, 0.8), (2.4, -2.9, 0.28, -1.0, 6.2, 1.0, 0.8),
           (2.9, 0.6, 0.85, -0.6, 5.2, 1.3, 0.95))


def limbs_of(rng):
    """[(from, to, radius, radius, is a finger)] of a hand, or of its fingers or forearm alone."""
    found = []
    what = rng.random()
    for x, y, dx, dy, length, wide, narrow in FINGERS:
        if what > 0.85 or rng.random() < 0.12:
            continue
        angle = rng.normal(0, 0.15)
        c, s = np.cos(angle), np.sin(angle)
        to = np.array([dx * c - dy * s, dx * s + dy * c])
        to *= length * rng.choice([1.0, rng.uniform(0.3, 1)]) / np.linalg.norm(to)
        found.append((np.array([x, y]), np.array([x, y]) + to, wide, narrow, True))
    if what > 0.15:
        found += [(np.array([-1.0, -0.6]), np.array([0.9, -0.6]), 3.0, 3.0, False),
                  (np.array([-0.6, 1.2]), np.array([0.8, 1.2]), 2.8, 2.8, False)]
        if rng.random() < 0.8:
            found.append((np.array([0.0, 2.0]), np.array([rng.normal(0, 1.5), 16.0]), 2.5, 3.2, False))
    return found


def draw_hand(rng, size):
    """float32 RGB in 0..1 and how far each pixel lies within the outline, px, negative outside."""
    unit = np.exp(rng.uniform(np.log(0.03), np.log(0.2))) * size
    angle = rng.uniform(0, 2 * np.pi)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    turn = turn @ np.diag([rng.choice([-1, 1]), 1])
    centre = rng.uniform(-0.1, 1.1, 2) * size
    yy, xx = np.mgrid[:size, :size].astype(np.float32)
    at = (np.stack([xx - centre[0], yy - centre[1]], -1) @ turn / unit).astype(np.float32)
    within = np.full((size, size), -1e3, np.float32)
    height = np.zeros((size, size), np.float32)
    shade = np.ones((size, size), np.float32)
    nail = np.zeros((size, size), bool)
    for a, b, wide, narrow, finger in limbs_of(rng):
        along = np.clip(((at - a) @ (b - a)) / ((b - a) @ (b - a)), 0, 1).astype(np.float32)
        off = np.linalg.norm(at - a - along[..., None] * (b - a), axis=-1).astype(np.float32)
        radius = wide + along * (narrow - wide)
        within = np.maximum(within, radius - off)
        height = np.maximum(height, np.sqrt(np.maximum(radius ** 2 - off ** 2, 0)))
        if finger:
            for joint in (0.33, 0.66):
                shade[(off < 0.85 * radius) & (np.abs(along - joint) < 0.03)] *= rng.uniform(0.6, 0.95)
            nail |= (along > 0.88) & (off < 0.6 * radius)
    height = cv2.GaussianBlur(height, (0, 0), max(0.6, 0.25 * unit)) * unit
    gy, gx = np.gradient(height)
    light = rng.uniform(0, 2 * np.pi)
    steep = rng.uniform(0.3, 1.2)
    lit = (1 - steep * (gx * np.cos(light) + gy * np.sin(light))) / np.sqrt(1 + gx ** 2 + gy ** 2)
    grain = cv2.GaussianBlur(rng.normal(0, 1, (size, size)).astype(np.float32), (0, 0), max(0.8, 0.06 * unit))
    blotch = cv2.GaussianBlur(rng.normal(0, 1, (size, size)).astype(np.float32), (0, 0), max(2, 0.8 * unit))
    tone = SKIN[rng.integers(len(SKIN))] * rng.uniform(0.85, 1.15) + rng.normal(0, 0.02, 3)
    glove = rng.random() < 0.2
    if glove:
        tone = rng.uniform(0.05, 0.9, 3)
    value = np.clip(0.25 + 0.75 * lit, 0.1, 1.4) * shade * (1 + 0.1 * grain + 0.4 * blotch)
    rgb = value[..., None] * tone.astype(np.float32)
    if not glove:
        rgb[nail] = rgb[nail] * 0.7 + 0.3 * np.float32([0.95, 0.8, 0.75]) * value[nail][:, None]
    return np.clip(rgb, 0, 1), within * unit


def ink(rng, x, y, dot):
    """Made-up glyphs of 3 x 5 dots in lines of writing."""
    column, row = np.floor(x / (4 * dot)).astype(int), np.floor(y / (8 * dot)).astype(int)
    i, j = np.floor(x / dot).astype(int) % 4, np.floor(y / dot).astype(int) % 8
    table = rng.random((64, 64, 3, 5)) < 0.55
    blank = rng.random((64, 64)) < 0.2
    column, row = column % 64, row % 64
    return (i < 3) & (j < 5) & ~blank[row, column] & table[row, column, np.minimum(i, 2), np.minimum(j, 4)]


def print_of(rng, x, y, a, b, colour):
    """What is on a card of half axes a and b px; x and y from its corner."""
    look = np.broadcast_to(colour, (*x.shape, 3)).astype(np.float32).copy()
    dark = np.float32([0.03, 0.03, 0.04]) if colour.mean() > 0.35 else np.float32([0.9, 0.9, 0.9])
    if rng.random() < 0.3:
        dark = rng.uniform(0, 0.6, 3).astype(np.float32)
    frame = rng.choice([0, 0.06, 0.12]) * b
    bare = (np.minimum(x, 2 * a - x) < frame) | (np.minimum(y, 2 * b - y) < frame)
    kind = rng.integers(5)
    if kind == 0:  # a ruler: ticks at one side, writing in the middle
        unit = max(3.0, rng.uniform(0.15, 0.6) * b)
        tick = (x % unit < 0.25 * unit) & (y < b * np.where(x % (5 * unit) < unit, 0.8, 0.4))
        look[tick] = dark
        dot = max(1.0, 0.05 * b)
        look[(y > 1.1 * b) & (y < 1.1 * b + 7 * dot) & ink(rng, x, y - 1.1 * b, dot)] = dark
    elif kind == 1:  # bars and chequers
        cells = rng.uniform(0.25, 1.0) * b
        odd = (np.floor(x / cells) + (np.floor(y / cells) if rng.random() < 0.6 else 0)) % 2 > 0
        part = y > (0 if rng.random() < 0.5 else b)
        look[odd & part & ~bare] = dark
    elif kind == 2:  # colour patches
        cells = rng.uniform(0.3, 0.9) * b
        table = rng.uniform(0.02, 0.9, (16, 16, 3)).astype(np.float32)
        column, row = np.floor(x / cells).astype(int) % 16, np.floor(y / cells).astype(int) % 16
        look[~bare] = table[row, column][~bare]
    elif kind == 3:
        look[ink(rng, x, y, max(1.0, rng.uniform(0.03, 0.12) * b)) & ~bare] = dark
    return look


def draw_flat(rng, size):
    """A card, a ruler, a coin, a pen or a shell; otherwise as draw_hand()."""
    kind = rng.choice(5, p=[0.35, 0.2, 0.15, 0.15, 0.15])
    a = np.exp(rng.uniform(np.log(0.06), np.log(0.7))) * size
    b = a * (rng.uniform(0.35, 1), rng.uniform(0.06, 0.25), 1, rng.uniform(0.03, 0.12), rng.uniform(0.8, 1.1))[kind]
    if kind in (2, 4):
        a, b = np.array([a, b]) / a * np.exp(rng.uniform(np.log(0.04), np.log(0.2))) * size
    b = max(b, 3.0)
    angle = rng.uniform(0, 2 * np.pi)
    centre = rng.uniform(0, 1, 2) * size
    yy, xx = np.mgrid[:size, :size].astype(np.float32)
    u = (xx - centre[0]) * np.cos(angle) + (yy - centre[1]) * np.sin(angle)
    v = (yy - centre[1]) * np.cos(angle) - (xx - centre[0]) * np.sin(angle)
    light = 0.7 + 0.3 * rng.random() + rng.normal(0, 0.1) * u / a
    tone = rng.choice(np.float32([[0.85, 0.85, 0.83], [0.8, 0.62, 0.1], [0.45, 0.45, 0.45], [0.06, 0.06, 0.07], [0.75, 0.6, 0.42]]))
    tone = np.clip(tone * rng.uniform(0.8, 1.2, 3), 0, 1).astype(np.float32)
    if kind < 2:
        corner = rng.choice([0, 0.3]) * b
        du, dv = np.abs(u) - a + corner, np.abs(v) - b + corner
        within = corner - np.hypot(np.maximum(du, 0), np.maximum(dv, 0)) - np.minimum(np.maximum(du, dv), 0)
        look = print_of(rng, u + a, v + b, a, b, tone)
    elif kind == 2:
        off = np.hypot(u, v)
        within = a - off
        grain = cv2.GaussianBlur(rng.normal(0, 1, (size, size)).astype(np.float32), (0, 0), max(0.8, 0.06 * a)) * a * 0.1
        relief = np.where(off > 0.85 * a, 0.25, np.where(off < 0.6 * a, np.clip(grain, -0.3, 0.3), 0))
        metal = np.float32([[0.62, 0.62, 0.6], [0.6, 0.42, 0.25], [0.7, 0.6, 0.3]])[rng.integers(3)]
        look = metal * np.float32(0.8 + relief + 0.25 * np.cos(np.arctan2(v, u) - rng.uniform(0, 6)))[..., None]
    elif kind == 4:  # a fan from the hinge, ribbed and banded
        x, y = u / a, v / b + 0.9
        angle, off = np.arctan2(x, y), np.hypot(x, y)
        ribs, reach = rng.integers(12, 32), 1.8 * np.cos(0.75 * np.clip(angle, -1.9, 1.9))
        within = (np.maximum(reach, 0.02) * (1 + 0.02 * np.cos(ribs * angle)) - off) * b
        tone = rng.choice(np.float32([[0.8, 0.72, 0.62], [0.75, 0.5, 0.4], [0.6, 0.55, 0.5], [0.4, 0.3, 0.3]]))
        dark = 1 + rng.uniform(0.05, 0.3) * np.cos(ribs * angle) + rng.uniform(0, 0.3) * np.sin(off * rng.uniform(5, 20))
        light = light * np.sqrt(np.clip(1 - (0.6 * off / np.maximum(reach, 0.1)) ** 2, 0.1, 1))
        look = tone * np.float32(dark)[..., None]
    else:
        within = b - np.hypot(v, np.maximum(np.abs(u) - a + b, 0))
        bands = rng.uniform(0.02, 0.9, (6, 3)).astype(np.float32)
        look = bands[np.clip((u / a + 1) * rng.uniform(0.5, 3), 0, 5).astype(int)]
        light = light * np.sqrt(np.maximum(1 - (v / b - 0.3) ** 2, 0.1))
    return np.clip(look * np.float32(light)[..., None], 0, 1), within.astype(np.float32)


def put_thing(rgb, planes, rng, border):
    """Lay a thing over a crop.

    rgb: float in 0..1. planes: px to the nearest border, inside, relative distance, weight; of what
    it covers in part, only the new border is known.
    """
    size = rgb.shape[0]
    thing, within = draw_hand(rng, size) if rng.random() < 0.4 else draw_flat(rng, size)
    cover = np.clip(within + 0.5, 0, 1)
    reach = rng.uniform(2, 0.1 * size)
    shift = np.float32([[1, 0, rng.normal(0, reach)], [0, 1, rng.normal(0, reach)]])
    shadow = cv2.GaussianBlur(cv2.warpAffine(cover, shift, (size, size)), (0, 0), reach)
    rgb = rgb * (1 - rng.uniform(0.1, 0.7) * shadow)[..., None]
    rgb = rgb + cover[..., None] * (thing * rng.uniform(0.6, 1.1) - rgb)
    edge, inside, distance, weight = (v.copy() for v in planes)
    on = within > 0
    rock_near = cv2.dilate(np.where(on, 0, inside).astype(np.float32), np.ones((5, 5), np.uint8)) > 0.5
    from_rim = np.maximum(np.abs(within) - 0.5, 0)
    edge = np.where(on, np.where(rock_near, from_rim, 1e3), np.where(inside > 0.5, np.minimum(edge, from_rim), edge))
    weight[(~on) & (inside > 0.5) & (within > -0.06 * size) & (within < -2 * border)] = 0
    inside[on] = 0
    distance[on] = 0
    weight[on] = 1
    return rgb.astype(np.float32), [edge.astype(np.float32), inside, distance, weight]
