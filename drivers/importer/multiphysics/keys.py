"""What svMultiPhysics has keys for, in each element of its file; and what those mean that Tunica has nothing for."""

GENERAL = """Check_IEN_order Continue_previous_simulation Convert_BIN_to_VTK_format Debug Increment_in_saving_restart_files
Increment_in_saving_VTK_files Name_prefix_of_saved_VTK_files Number_of_initialization_time_steps Number_of_spatial_dimensions
Number_of_time_steps Overwrite_restart_file Restart_file_name Save_averaged_results Save_results_in_folder
Save_results_to_VTK_format Searched_file_name_to_trigger_stop Simulation_initialization_file_path
Simulation_requires_remeshing Spectral_radius_of_infinite_time_step Start_averaging_from_zero Start_saving_after_time_step
Starting_time_step Time_step_size Verbose Warning"""
DOMAIN = """Absolute_tolerance Anisotropic_conductivity Backflow_stabilization_coefficient Conductivity Constitutive_model
Continuity_stabilization_coefficient Density Dilational_penalty_model Elasticity_modulus Electrophysiology_model Equation
Feedback_parameter_for_stretch_activated_currents Fiber_reinforcement_stress Fluid_density Force_x Force_y Force_z
Inverse_darcy_permeability Isotropic_conductivity Mass_damping Maximum_iterations Momentum_stabilization_coefficient
Myocardial_zone ODE_solver Penalty_parameter Poisson_ratio Relative_tolerance Shell_thickness Solid_density Source_term
Stimulus Time_step_for_integration Viscosity"""
CONDITION = """Apply_along_normal_direction Bct_file_path Coupling_interface CST_shell_bc_type Damping Distal_pressure
Effective_direction Follower_pressure_load Fourier_coefficients_file_path Impose_flux Impose_on_state_variable_integral
Initial_displacements_file_path Penalty_parameter Penalty_parameter_normal Penalty_parameter_tangential Prestress_file_path
Profile Ramp_function RCR_values Resistance Spatial_profile_file_path Spatial_values_file_path Stiffness svZeroDSolver_block
Temporal_and_spatial_values_file_path Temporal_values_file_path Time_dependence Traction_multiplier Traction_values_file_path
Type Undeforming_neu_face Value Weakly_applied Zero_out_perimeter"""
EQUATION = """Add_BC Add_BF Coupled Couple_to_cplBC Couple_to_genBC Domain ECGLeads Explicit_geometric_coupling Initialize
Initialize_RCR_from_flow LS Max_iterations Min_iterations Output Prestress Remesher svOneDSolver_interface
svZeroDSolver_interface Tolerance Use_taylor_hood_type_basis Variable_wall_properties"""
MESH = """Add_face Domain Domain_file_path Fiber_direction Fiber_direction_file_path Initial_displacements_file_path
Initial_pressures_file_path Initial_velocities_file_path Mesh_file_path Mesh_scale_factor Prestress_file_path
Quadrature_modifier_TET4 Set_mesh_as_fibers Set_mesh_as_shell"""
LAW = "a a0 a4 a4f a4s a6 afs b b1 b2 b4 b4f b4s b6 bf bfs bt c c1 c2 k kappa mu0 Add_row"
VISCOSITY = """Asymptotic_viscosity_parameter Limiting_high_shear_rate_viscosity Limiting_low_shear_rate_viscosity
Low_shear_rate_threshold Power_law_index Shear_rate_tensor_exponent Shear_rate_tensor_multiplier Value
Yield_stress_parameter"""

ANYWHERE = {"Include_xml"}
OF = {tag: set(words.split()) | ANYWHERE for tag, words in {
    "svMultiPhysicsFile": """GeneralSimulationParameters Add_mesh Add_projection Add_equation Contact Precomputed_solution
                             Add_RIS_projection Add_URIS_mesh""",
    "GeneralSimulationParameters": GENERAL, "Add_mesh": MESH, "Domain": DOMAIN, "Add_BC": CONDITION,
    "Add_equation": EQUATION + " " + DOMAIN, "Constitutive_model": LAW, "Viscosity": VISCOSITY,
    "Add_face": "End_nodes_face_file_path Face_file_path Quadrature_modifier_TRI3",
    "Add_projection": "Project_from_face Projection_tolerance",
    "RCR_values": "Capacitance Distal_pressure Distal_resistance Initial_pressure Proximal_resistance",
    "Coupling_interface": """Chamber_cap_surface Ramp_ref_pressure Ramp_steps Relax_factor svOneDSolver_input_file
                             svZeroDSolver_block""",
    "svZeroDSolver_interface": """Configuration_file Coupling_type Flowrate_conversion_factor Initial_flows
                                  Initial_pressures Pressure_conversion_factor Shared_library""",
}.items()}
OF["svFSIFile"] = OF["svMultiPhysicsFile"]  # as the file was called before

# Of no effect on what is computed; nobody need be told.
SILENT = {"Check_IEN_order", "Convert_BIN_to_VTK_format", "Debug", "Verbose", "Warning", "Name_prefix_of_saved_VTK_files",
          "Overwrite_restart_file", "Restart_file_name", "Searched_file_name_to_trigger_stop", "Coupled", "Shared_library",
          "Number_of_spatial_dimensions", "Quadrature_modifier_TET4", "Quadrature_modifier_TRI3", "End_nodes_face_file_path",
          "Save_results_in_folder", "Coupling_type", "Start_saving_after_time_step", "Initial_flows"}

FROM_REST = "the run begins at rest; Time / initial state takes the fields of another run of Tunica"
OWN_STABILISATION = "Fluid / stabilisation has its own parameters"
OWN_NEWTON = "Newton's method stops by its own rule, Coupling / Newton"

# key: (what it means there, what was done here), where it is read nowhere.
MEANING = {
    "Continue_previous_simulation": ("goes on from the files of an earlier run", FROM_REST),
    "Number_of_initialization_time_steps": ("steps before the first one that counts", "left out"),
    "Simulation_initialization_file_path": ("fields at the start", FROM_REST),
    "Initial_displacements_file_path": ("displacement at the start", FROM_REST),
    "Initial_pressures_file_path": ("pressure at the start", FROM_REST),
    "Initial_velocities_file_path": ("velocity at the start", FROM_REST),
    "Simulation_requires_remeshing": ("a new mesh where elements become bad", "the mesh only moves"),
    "Remesher": ("a new mesh where elements become bad", "the mesh only moves"),
    "Save_averaged_results": ("means over time", "Output / averages from averages the wall shear stress"),
    "Start_averaging_from_zero": ("means over time", "Output / averages from averages the wall shear stress"),
    "Starting_time_step": ("number of the first step", "the run begins at zero"),
    "Max_iterations": ("cap on Newton's steps", OWN_NEWTON),
    "Min_iterations": ("least number of Newton's steps", OWN_NEWTON),
    "Tolerance": ("residual at which Newton's method stops", OWN_NEWTON),
    "LS": ("linear solver and preconditioner", "Tunica's own are used, Coupling / Linear Solver"),
    "Output": ("names of the results", "fields.h5 and steps.csv hold Tunica's results: velocity, pressure, displacement, "
               "stresses, wall shear stress"),
    "Continuity_stabilization_coefficient": ("stabilisation of continuity", OWN_STABILISATION),
    "Momentum_stabilization_coefficient": ("stabilisation of momentum", OWN_STABILISATION),
    "Use_taylor_hood_type_basis": ("quadratic velocities", "linear elements for velocity and pressure, stabilised"),
    "Explicit_geometric_coupling": ("mesh moved once in a step", "Coupling / geometry = extrapolated is alike"),
    "Force_x": ("body force", "left out"), "Force_y": ("body force", "left out"), "Force_z": ("body force", "left out"),
    "Add_BF": ("body force", "left out"), "Source_term": ("source", "left out"),
    "Mass_damping": ("damping proportional to the mass", "left out"),
    "Inverse_darcy_permeability": ("resistance of a porous medium", "left out"),
    "Fiber_reinforcement_stress": ("active stress along fibres", "left out: the wall is passive"),
    "Initialize": ("solves the wall alone first", "left out"),
    "Initialize_RCR_from_flow": ("pressures of Windkessels from the flow at the start", "initial pressure is taken"),
    "Couple_to_genBC": ("a network of another program behind the outlets", "its surfaces are free"),
    "Couple_to_cplBC": ("a network of another program behind the outlets", "its surfaces are free"),
    "svOneDSolver_interface": ("one-dimensional vessels behind the outlets", "their surfaces are free"),
    "Variable_wall_properties": ("stiffness that varies along the wall", "left out"),
    "Contact": ("contact between surfaces", "left out"),
    "Precomputed_solution": ("a flow computed before", "left out"),
    "Add_RIS_projection": ("a valve as a resistive surface", "left out"),
    "Add_URIS_mesh": ("a valve as a resistive surface", "left out"),
    "Set_mesh_as_fibers": ("a mesh of lines", "left out"), "Set_mesh_as_shell": ("a wall without thickness", "left out"),
    "Undeforming_neu_face": ("a loaded face that keeps its shape", "the face deforms"),
    "Prestress_file_path": ("stress of the wall at the start", "see Wall / Prestress"),
    "Projection_tolerance": ("how near vertices of both meshes are the same", "--tolerance, in mm"),
    "Distal_pressure": ("pressure behind the outlet", "left out"),
    "Traction_multiplier": ("factor of a traction", "left out"),
}
