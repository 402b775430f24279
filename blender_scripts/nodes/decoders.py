"""The decoder of each encoding, by its name, as a group of shader nodes. The same formulas as src/encoding/ has, which
names their papers."""
from nodes import directions, lobes, rnm, series

DECODERS = {
    "flat": rnm.make_flat, "rnm": rnm.make_rnm, "rnm-vrad": rnm.make_rnm_vrad, "rnm-signed": rnm.make_rnm_signed,
    "rnm-bakery": rnm.make_rnm_bakery,
    "sh2": lobes.make_sh2, "zh3": lobes.make_zh3, "geomerics": lobes.make_geomerics,
    "ahd": directions.make_ahd, "dominant": directions.make_dominant,
    "sh3": series.make_sh3, "h4": series.make_h4, "h6": series.make_h6, "sg": series.make_sg}
