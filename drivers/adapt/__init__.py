"""Parts of tunica-adapt: what a run was wrong about, the sizes that follow, and the mesh of them."""
