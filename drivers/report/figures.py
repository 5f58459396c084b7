"""All pictures of a run, in the order of the page."""
from report import viewer
from report.canvas import save
from report.curve_figures import bulge, curves, line_of, observables
from report.iteration_figures import counts, coupling_history, newton_history
from report.section_figures import default_magnification, plane_of, section
from report.space_figures import SpacePictures
from report.surfaces import VesselSurfaces


def draw_all(run, clinic, folder, outputs, step, look):
    """Draws what the run permits. clinic: of a vessel with a beat, or None; look: magnification, and normal and level
    of what cuts the vessel, each None where it is chosen here. Returns the figures, and the page with the vessel to be
    turned, or None."""
    jobs, page, (magnify, wanted_plane) = clinic.figures() if clinic else [], None, look
    if outputs:
        surfaces = clinic.parts.surfaces if clinic and clinic.parts else VesselSurfaces(run)
        line = line_of(run, surfaces)
        plane = plane_of(run, line, wanted_plane)
        factor = magnify if magnify is not None else default_magnification(run, outputs, plane)
        page = viewer.write(run, clinic, surfaces, folder, (factor, plane))
        jobs += SpacePictures(run, surfaces, outputs, factor, plane).jobs()
        shown = ("velocity", "pressure") if "fluid" in run.grids() else ("wall",)
        jobs += [lambda q=q: section(run, outputs, q, factor, plane) for q in shown]
        jobs.append(lambda: bulge(run, outputs, line))
    jobs += [lambda: curves(run), lambda: coupling_history(run, step), lambda: counts(run),
             lambda: newton_history(run, step), lambda: observables(run)]
    return save(jobs, folder) + (clinic.pictures(folder) if clinic else []), page
