"""Reading meshes of other programs and putting them in order, for tunica-import."""
