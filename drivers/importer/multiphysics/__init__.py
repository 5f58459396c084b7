"""Translates a case of svMultiPhysics (solver.xml) into one of Tunica, for tunica-import."""
