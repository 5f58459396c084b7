"""What a case assumes, in sentences, from its parameters."""
from report.flow_tables import numbers_of
from vessel.units import mmhg


def value(case, path, name, default=None):
    """A parameter of a list; path: names of lists."""
    node = case.find("./" + "/".join(f"ParameterList[@name='{p}']" for p in path))
    found = node.find(f"./Parameter[@name='{name}']") if node is not None else None
    return default if found is None else found.get("value")


def lists(case, *path):
    node = case.find("./" + "/".join(f"ParameterList[@name='{p}']" for p in path))
    return node.findall("ParameterList") if node is not None else []


def sentences(case, beat, record):
    fluid = lambda name, default=None: value(case, ["Fluid"], name, default)  # noqa: E731
    law = fluid("law", "newtonian")
    blood = f"Blood is {law}, {float(fluid('viscosity', 0.0035)) * 1000:g} mPa s" if law == "newtonian" else f"Blood: {law}"
    found = [blood + f", {float(fluid('density', 1.0)):g} g/ml; the flow is not turbulent."]
    inlet = numbers_of(case, beat.inlet)
    profile = f", its profile {inlet['profile']}" if "profile" in inlet else ""
    found.append(f"At {beat.inlet}: {inlet.get('condition', 'an open end')}{profile}, repeated every {beat.period:g} ms.")
    ends = {}
    for name in beat.outlets:
        ends.setdefault(numbers_of(case, name).get("condition", "an open end"), []).append(name)
    found += [f"At {', '.join(names)}: {condition}." for condition, names in ends.items()]
    return found + of_wall(case, record.get("prestress", {}))


def of_wall(case, prestress):
    """prestress: of the run's record, {} where it has none."""
    layers = lists(case, "Wall", "Layers")
    if not layers:
        return ["The wall is rigid."] if not lists(case, "Wall") else []
    laws = [f"{layer.get('name')} {value(case, ['Wall', 'Layers', layer.get('name')], 'law', 'mooney-rivlin')}" for layer in layers]
    found = [f"Layers of the wall: {', '.join(laws)}; their constants are those of the case, of no one person unless fitted."]
    pressure = value(case, ["Wall", "Prestress"], "pressure")
    if pressure is not None:
        found.append(f"The mesh is the shape of the vessel at {mmhg(float(pressure)):.0f} mmHg ({float(pressure):.4g} kPa); its stress there "
                     "balances that pressure.")
        held = prestress.get("tissue holds at most kPa", 0.0)
        if held > 0.01 * float(pressure):
            found.append(f"The wall alone does not bear it everywhere: the tissue holds at most {mmhg(held):.0f} mmHg of it, "
                         f"{mmhg(prestress['tissue holds kPa']):.1f} mmHg in the root mean square.")
    else:
        found.append("The mesh is the shape of the vessel without load.")
    for surface in lists(case, "Wall", "Surfaces"):
        keys = {p.get("name"): p.get("value") for p in surface.findall("Parameter")}
        if keys.get("condition") == "support":
            found.append(f"Tissue at {surface.get('name')}: {float(keys.get('stiffness', 0)):g} kPa/mm, damping "
                         f"{float(keys.get('damping', 0)):g} kPa ms/mm.")
        elif keys.get("condition") in ("clamped", "held"):
            found.append(f"The wall is {keys['condition']} at {surface.get('name')}.")
    return found
