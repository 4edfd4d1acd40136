"""What grows: a linden of limbs, twigs and leafy cards, ivy on walls, herbs in pots. Leaves are pictures with alpha on bent
sheets; their normals lean outwards, so that a crown is shaded as a round thing."""
import functools
import math

import numpy as np

from kit.mesh import Mesh, Model, merge
from kit.noise import rng
from kit.plants import pot
from kit.shapes import oriented, surface, sweep
from kit.transform import rotate, rotate_x, rotate_y, rotate_z, scale, translate

from . import materials as M

GOLDEN = 2.39996


@functools.lru_cache
def sheet(bend, divisions):
    t = np.linspace(0, 1, divisions + 1)[None, :]
    s = np.linspace(-0.5, 0.5, divisions + 1)[:, None]
    y = -bend * t ** 2 + 0.18 * np.abs(s) * 2 * t
    points = np.stack(np.broadcast_arrays(s, y, t), -1)
    return surface(points, np.stack(np.broadcast_arrays(s + 0.5, 1 - t), -1), swap=True)


def card(size, bend, divisions=2):
    """A sheet that grows from the origin along +Z and droops, its top to +Y; the picture's root is at the origin."""
    mesh = sheet(round(bend * 20) / 20, divisions).at(scale(size))
    mesh.triangles = mesh.triangles.copy()  # sheets are turned over one by one
    return mesh


def leaning(mesh, centre, share):
    """The mesh with normals that lean away from a centre; sheets look outwards."""
    away = mesh.positions - centre
    away /= np.maximum(np.linalg.norm(away, axis=1, keepdims=True), 1e-9)
    facing = np.where(np.sum(mesh.normals * away, axis=1, keepdims=True) < 0, -mesh.normals, mesh.normals)
    normals = (1 - share) * facing + share * away
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return oriented(Mesh(mesh.positions, normals, mesh.uvs, mesh.triangles))


def bow(start, direction, length, lift, wobble, r, count):
    """Points of a limb that bends upwards or down."""
    points, at, way = [np.asarray(start, float)], np.asarray(start, float), np.asarray(direction, float)
    for _ in range(count - 1):
        way = way + (0, lift / count, 0) + r.uniform(-wobble, wobble, 3)
        way /= np.linalg.norm(way)
        at = at + way * length / (count - 1)
        points.append(at)
    return np.array(points), way


def linden(name="linden", seed=17, height=2.5):
    """Trunk, limbs, branches, twigs; about 1000 cards of leaves."""
    model, r = Model(name), rng(seed)
    bark, cards = [], []
    trunk, way = bow((0, -0.1, 0), (0.05, 1, 0.03), height, 0.0, 0.05, r, 7)
    bark.append(sweep(trunk, np.linspace(0.19, 0.13, 7) + np.array([0.07, 0.02, 0, 0, 0, 0, 0]), 12))
    crown = np.array([0.0, height + 1.6, 0.0])

    def twig(start, direction, length):
        path, _ = bow(start, direction, length, -0.25, 0.16, r, 4)
        bark.append(sweep(path, np.linspace(0.014, 0.005, 4), 4, caps=False))
        for k in range(9):
            f = (0.15 + 0.85 * (k + 0.5) / 9) * 3
            i = min(int(f), 2)
            at = path[i] + (path[i + 1] - path[i]) * (f - i)
            turn = k * GOLDEN + r.uniform(-0.4, 0.4)
            m = translate(*at) @ rotate_y(turn) @ rotate_x(r.uniform(-0.5, 0.7)) @ rotate_z(r.uniform(-0.6, 0.6))
            cards.append(leaning(card(r.uniform(0.34, 0.52), r.uniform(0.1, 0.45)).at(m), crown, 0.45))

    def limb(start, direction, length, radius, level):
        path, last = bow(start, direction, length, 0.35 if level else 0.1, 0.12, r, 6)
        bark.append(sweep(path, np.linspace(radius, radius * 0.5, 6), 8 if level else 6, caps=False))
        shoots = 5 if level else 4
        for k in range(shoots):
            f = 1.6 + 3.4 * (k + 1) / shoots
            at = path[min(int(f), 5)]
            side = np.cross(last, (math.cos(k * GOLDEN), 0.3, math.sin(k * GOLDEN)))
            side /= np.linalg.norm(side)
            out = 0.65 * last + 0.8 * side + r.uniform(-0.15, 0.15, 3)
            out /= np.linalg.norm(out)
            if level:
                limb(at, out, length * r.uniform(0.55, 0.75), radius * 0.5, level - 1)
            else:
                twig(at, out, length * r.uniform(0.6, 0.9))

    for k in range(5):
        turn = k * 2 * math.pi / 5 + r.uniform(-0.3, 0.3)
        steep = 0.75 + 0.35 * (k % 2)
        limb(trunk[-1 - (k % 2)], np.array([math.cos(turn), steep, math.sin(turn)]) / math.hypot(1, steep),
             r.uniform(1.35, 1.75), 0.085, 1)
    limb(trunk[-1], way, 1.6, 0.09, 1)
    model.add(M.BARK, merge(bark))
    return model.add(M.LEAVES, merge(cards))


def ivy(name, width, height, count, seed):
    """Leafy cards on a wall in the XY plane that faces +Z, dense below, thinning upwards in tongues."""
    model, r = Model(name), rng(seed)
    cards = []
    tongues = r.uniform(0.35, 1.0, 9)
    while len(cards) < count:
        x, t = r.uniform(-0.5, 0.5), r.uniform(0, 1) ** 1.4
        place = (x + 0.5) * 8
        reach = np.interp(place, np.arange(9), tongues) * (1 - 0.6 * (2 * x) ** 4)
        if t > reach:
            continue
        m = (translate(x * width, t * height, r.uniform(0.01, 0.05)) @ rotate_z(r.uniform(-2.2, 2.2)) @
             rotate_x(-math.pi / 2 + r.uniform(0.12, 0.6)))
        cards.append(oriented(card(r.uniform(0.20, 0.34), 0.25, 1).at(m)))
    for mesh in cards:  # sheets look away from the wall
        if mesh.normals[:, 2].sum() < 0:
            mesh.normals, mesh.triangles = -mesh.normals, mesh.triangles[:, ::-1]
    return model.add(M.IVY, merge(cards))


def herbs(name, material, radius, count, size, seed):
    """A pot full of upright sprigs."""
    model, r = Model(name), rng(seed)
    pot(model, M.TERRACOTTA, M.SOIL, radius, radius * 1.5)
    cards = []
    for k in range(count):
        turn, out = k * GOLDEN, radius * 0.75 * math.sqrt((k + 0.5) / count)
        lean = 0.25 + 0.6 * out / radius
        m = (translate(out * math.cos(turn), radius * 1.3, -out * math.sin(turn)) @ rotate_y(turn + math.pi / 2) @
             rotate((1, 0, 0), -math.pi / 2 + lean + r.uniform(-0.15, 0.15)) @ rotate_z(r.uniform(-1.5, 1.5)))
        cards.append(leaning(card(size * r.uniform(0.75, 1.2), 0.15).at(m), np.array([0, radius, 0]), 0.5))
    return model.add(material, merge(cards))
