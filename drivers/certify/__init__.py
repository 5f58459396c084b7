"""Runs a case on other meshes, with other steps and tolerances, and tells the errors of its numbers: the parts of tunica-certify."""
