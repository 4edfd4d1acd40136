"""Modelling kit of Kilolux: meshes, textures, lights and a glTF writer, in Python with numpy alone.

Everything is deterministic: random numbers come from seeds, and what is written is rounded to a grid far
coarser than floating-point differences between machines, so the same program gives the same bytes.
"""
