"""From the surface of a vessel's lumen to a mesh of tetrahedra, for tunica-lumen."""
