"""How a folded mesh is put on the table, as somebody would put it there."""
import numpy as np

UPSIDE_DOWN = np.diag([1, -1, -1])


def middle_of(mesh):
    return mesh.corners.mean(axis=1)


def area_weights(mesh):
    edges = mesh.corners[:, 1:] - mesh.corners[:, :1]
    return np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)


def turn_about_y(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def level_ends(mesh):
    """Turns a strip about y until both of its ends are equally high."""
    points = middle_of(mesh)
    count = max(1, len(points) // 40)
    first, last = points[:count].mean(axis=0), points[-count:].mean(axis=0)
    return mesh.turned(turn_about_y(np.arctan2(last[2] - first[2], last[0] - first[0])))


def is_top_heavy(mesh):
    """Finds whether the mean of the surface lies in the upper half."""
    low, high = mesh.bounds()
    height = np.average(middle_of(mesh)[:, 2], weights=area_weights(mesh))
    return height > (low[2] + high[2]) / 2


def most_common(normals):
    """Returns the normal that most bodies have, and the next one that is perpendicular to it."""
    parallel = normals @ normals.T > 0.999
    first = normals[np.argmax(parallel.sum(axis=1))]
    beside = normals[np.abs(normals @ first) < 0.2]
    if not len(beside):
        beside = np.cross(first, [[1, 0, 0], [0, 1, 0]])
    second = beside[np.argmax((np.abs(beside @ beside.T) > 0.999).sum(axis=1))]
    second = second - (second @ first) * first
    return first, second / np.linalg.norm(second)


def frame_of(up, right):
    """Returns the rotation that takes `up` to z and `right` to x."""
    return np.stack([right, np.cross(up, right), up])


def posed(mesh, posture, places, normals):
    """Returns the mesh as `posture` says: `sheet` leaves it, `arch` stands on its ends, `bowl` opens upwards and
    stands on its largest face, `dome` opens downwards, and `tall` stands on its longest axis.

    places and normals: of the sheet at each body, in the state of the mesh (n x 3), or None if they are unknown."""
    if posture == "bowl" and normals is not None:
        mesh = mesh.turned(frame_of(*most_common(normals)))
    if posture == "dome" and normals is not None:
        up = normals.sum(axis=0) / np.linalg.norm(normals.sum(axis=0))
        crown, rim = (places[np.argsort(normals @ up)[part]].mean(axis=0) for part in (slice(-len(places) // 4, None), slice(len(places) // 4)))
        up = up if (crown - rim) @ up > 0 else -up
        side = np.cross(up, [0, 0, 1] if abs(up[2]) < 0.9 else [0, 1, 0])
        mesh = mesh.turned(frame_of(up, side / np.linalg.norm(side)))
    if posture == "arch":
        mesh = level_ends(mesh)
        return mesh if is_top_heavy(mesh) else mesh.turned(UPSIDE_DOWN)
    if posture == "bowl":
        return mesh.turned(UPSIDE_DOWN) if is_top_heavy(mesh) else mesh
    if posture == "tall":
        order = np.argsort(mesh.size())
        rotation = np.eye(3)[order]
        if np.linalg.det(rotation) < 0:
            rotation[0] *= -1
        return mesh.turned(rotation)
    return mesh
