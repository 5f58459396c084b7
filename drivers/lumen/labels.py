"""Where labels go, so that none overlaps another: the nearest free place on rings about its anchor, away from the middle
first. The page in motion of tunica-report does the same (report/viewer.html)."""
import math

GAP, FIRST, STEP, AROUND = 4.0, 14.0, 10.0, 24  # pixels, between rings, places on a ring


def places(anchors, sizes, frame):
    """Boxes (left, bottom, width, height) in a frame (width, height); None where there is no room."""
    placed, found = [], []
    for anchor, size in zip(anchors, sizes):
        found.append(place(anchor, size, placed, frame))
        placed += [found[-1]] if found[-1] else []
    return found


def place(anchor, size, placed, frame):
    away = math.atan2(anchor[1] - frame[1] / 2, anchor[0] - frame[0] / 2)
    ring = FIRST
    while ring < sum(frame):
        for k in range(AROUND):
            angle = away + (1 if k % 2 else -1) * math.ceil(k / 2) * 2 * math.pi / AROUND
            box = (anchor[0] + (ring + size[0] / 2) * math.cos(angle) - size[0] / 2,
                   anchor[1] + (ring + size[1] / 2) * math.sin(angle) - size[1] / 2, *size)
            if all(0 <= box[i] and box[i] + box[i + 2] <= frame[i] for i in (0, 1)) and not any(touches(box, b) for b in placed):
                return box
        ring += STEP
    return None


def touches(a, b):
    return all(a[i] < b[i] + b[i + 2] + GAP and b[i] < a[i] + a[i + 2] + GAP for i in (0, 1))


def draw(axis, names, points):
    """Names at points of an axis whose place in the figure no longer changes, each with a line to its point."""
    canvas = axis.figure.canvas
    axis.apply_aspect()
    texts = [axis.text(0, 0, name, fontsize=9) for name in names]
    sizes = [(box.width + 4, box.height + 4) for box in (text.get_window_extent(canvas.get_renderer()) for text in texts)]
    for text in texts:
        text.remove()
    corner, frame = axis.bbox.p0, axis.bbox.size
    anchors = axis.transData.transform(points) - corner
    for name, point, box in zip(names, points, places(anchors.tolist(), sizes, frame.tolist())):
        if box:
            middle = (box[0] + box[2] / 2 + corner[0], box[1] + box[3] / 2 + corner[1])
            axis.annotate(name, point, xytext=middle, textcoords="figure pixels", fontsize=9, ha="center", va="center",
                          bbox={"fc": "white", "ec": "none", "alpha": 0.8, "pad": 1}, arrowprops={"arrowstyle": "-", "lw": 0.7, "color": "#444444"})
