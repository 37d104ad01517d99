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


def posed(mesh, posture):
    """Returns the mesh as `posture` says: `flat` and `sheet` leave it, `arch` stands on its ends, `bowl` opens upwards, `dome`
    opens downwards, and `tall` stands on its longest axis."""
    if posture == "arch":
        mesh = level_ends(mesh)
        return mesh if is_top_heavy(mesh) else mesh.turned(UPSIDE_DOWN)
    if posture in ("bowl", "dome"):
        return mesh if is_top_heavy(mesh) == (posture == "dome") else mesh.turned(UPSIDE_DOWN)
    if posture == "tall":
        order = np.argsort(mesh.size())
        rotation = np.eye(3)[order]
        if np.linalg.det(rotation) < 0:
            rotation[0] *= -1
        return mesh.turned(rotation)
    return mesh
