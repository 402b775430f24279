"""One sun and many small planes, each turned so that the sun stands elsewhere in its tangent frame.

sun_<angle>_<azimuth>: the sun stands <angle> degrees off the plane's normal and <azimuth> degrees from its
tangent (+u of UVMap) towards its bitangent (+v). A prefix says what else is unusual about the plane:

  scaled_    non-uniform object scale over a tilted mesh: normals need the inverse transpose
  mirrored_  negative object scale: the frame is left-handed
  mirroruv_  u runs backwards: the frame is left-handed
  far_       1 km from the origin
  tiny_      1 mm wide

Right answer: max(0, d . b) x strength / pi with d = (sin a cos z, sin a sin z, cos a), and 0 beyond 90 degrees.
The planes stand side by side as the sun sees them, so that no plane shades another; bake them without bounces.
They keep close to the origin and the plain ones are 1 m wide: where a ray starts at an edge between two triangles
Cycles lifts it by up to 256 float steps of its coordinates (2 mm at 80 m), enough for a sun at 95 degrees to slip
past the rim of a small plane.
"""

import math

from mathutils import Matrix, Vector

import kit

ANGLES = (0, 30, 54.7, 70, 80, 85, 95)
VARIANT_ANGLES = (54.7, 70)
AZIMUTHS = (0, 120, 210, 300)
TO_SUN = Vector((0.3, -0.5, 0.8)).normalized()
SPACING = 2.0


class Variant:
    def __init__(self, half=0.05, tilt=0.0, scale=(1, 1, 1), mirror_u=False, away=0.0):
        self.half, self.tilt, self.scale = half, tilt, scale
        self.mirror_u, self.away = mirror_u, away


VARIANTS = {
    "tiny_": Variant(half=0.0005),
    "scaled_": Variant(tilt=25.0, scale=(1.7, 0.6, 1.3)),
    "mirrored_": Variant(scale=(-1, 1, 1)),
    "mirroruv_": Variant(mirror_u=True),
    "far_": Variant(away=1000.0),
}


def _spiral():
    """Cells of a square grid, nearest to the middle first: the tiny planes need the most precise places."""
    cells = [(x, y) for x in range(-6, 7) for y in range(-6, 7)]
    return iter(sorted(cells, key=lambda c: (c[0] ** 2 + c[1] ** 2, c)))


def _plane(name, variant, angle, azimuth, place, material):
    tilt = Matrix.Rotation(math.radians(variant.tilt), 3, "X")  # about u: the scaled u and v stay at right angles
    u, v = tilt @ Vector((1, 0, 0)), tilt @ Vector((0, 1, 0))
    half = variant.half
    builder = kit.Builder(tile=2 * half, margin=0.0)
    builder.quad(-half * (u + v), 2 * half * u, 2 * half * v)
    if variant.mirror_u:
        builder.detail = [[(1 - s, t) for s, t in face] for face in builder.detail]

    scale = Matrix.Diagonal(variant.scale)
    tangent = (scale @ u).normalized() * (-1 if variant.mirror_u else 1)
    bitangent = (scale @ v).normalized()
    normal = (scale.inverted().transposed() @ u.cross(v)).normalized()
    d = kit.direction(angle, azimuth)
    to_sun = tangent * d.x + bitangent * d.y + normal * d.z
    turn = to_sun.rotation_difference(TO_SUN).to_matrix()
    builder.object(name, [material], Matrix.Translation(place) @ (turn @ scale).to_4x4())


def build(strength=math.pi):
    kit.start()
    material = kit.diffuse("plane", (0.5, 0.5, 0.5))
    right = TO_SUN.orthogonal().normalized()
    up = TO_SUN.cross(right)
    cells = _spiral()

    def place(away=0.0):
        x, y = next(cells)
        return right * (x * SPACING + away) + up * (y * SPACING)

    def unusual(prefixes):
        for prefix in prefixes:
            for angle in VARIANT_ANGLES:
                for azimuth in AZIMUTHS:
                    name, variant = f"{prefix}sun_{angle:g}_{azimuth}", VARIANTS[prefix]
                    _plane(name, variant, angle, azimuth, place(variant.away), material)

    unusual(["tiny_"])  # needs the most precise places, next to the origin
    for angle in ANGLES:
        for azimuth in AZIMUTHS:
            _plane(f"sun_{angle:g}_{azimuth}", Variant(half=0.5), angle, azimuth, place(), material)
    unusual([prefix for prefix in VARIANTS if prefix != "tiny_"])
    kit.sun(TO_SUN, strength)
    kit.world()
    kit.camera(TO_SUN * 400, (0, 0, 0))
