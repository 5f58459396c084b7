#include <mpi.h>

#include <Teuchos_DefaultMpiComm.hpp>
#include <cstdlib>
#include <exception>
#include <functional>
#include <memory>
#include <new>
#include <string>

#include "tunica/base/error.hpp"
#include "tunica/base/exception_summary.hpp"
#include "tunica/base/out_of_memory.hpp"
#include "tunica/base/session.hpp"
#include "tunica/foreign/problem.hpp"
#include "tunica/foreign/tunica.h"

struct tunica_solver {
  tunica_report report{};
  std::string message, setting, notes, settings;
  std::unique_ptr<tunica::foreign::Problem> problem;
};

namespace {

using namespace tunica;

/// Of all solvers. It ends with the program: others may use MPI and Kokkos up to then.
void begin_session() {
  static Session* session = nullptr;
  if (session != nullptr) return;
  session = new Session;
  std::atexit([] { delete session; });
}

/// A copy, whose messages meet no others.
CommPtr ranks_of(const int* communicator) {
  MPI_Comm copy = MPI_COMM_NULL;
  MPI_Comm_dup(communicator == nullptr ? MPI_COMM_SELF : MPI_Comm_f2c(*communicator), &copy);
  const Teuchos::RCP<const Teuchos::OpaqueWrapper<MPI_Comm>> wrapped =
      Teuchos::opaqueWrapper(copy, Teuchos::details::safeCommFree);
  return Teuchos::rcp(new Teuchos::MpiComm<int>(wrapped));
}

/// Texts of the report are those of the solver.
int finish(tunica_solver& solver, int status, const std::string& message) {
  solver.message = message;
  solver.report.status = status;
  solver.report.message = solver.message.c_str();
  solver.report.setting = solver.setting.c_str();
  solver.report.notes = solver.notes.c_str();
  solver.report.settings = solver.settings.c_str();
  return status;
}

void describe(tunica_solver& solver) {
  const foreign::Problem& problem = *solver.problem;
  solver.notes = problem.notes();
  solver.settings = problem.case_in_use();
  solver.setting = problem.setting();
  solver.report.unknowns = problem.n_unknowns();
  solver.report.setup_seconds = problem.seconds().set_up;
  solver.report.refresh_seconds = problem.seconds().refresh;
  solver.report.solve_seconds = problem.seconds().solve;
}

/// Status and message.
using Ending = std::pair<int, std::string>;

/// Does the work and lets nothing out.
int guarded(tunica_solver* solver, const std::function<Ending()>& work) {
  if (solver == nullptr) return TUNICA_FAULT;
  try {
    const auto [status, message] = work();
    describe(*solver);
    return finish(*solver, status, message);
  } catch (const Error& error) {
    return finish(*solver, TUNICA_BAD_INPUT, error.what());
  } catch (const std::exception& error) {
    return finish(*solver, TUNICA_FAULT,
                  is_out_of_memory(error) ? out_of_memory_text() : exception_summary(error.what()));
  } catch (...) {
    return finish(*solver, TUNICA_FAULT, "an exception of unknown type");
  }
}

/// What has been set up.
foreign::Problem& problem_of(tunica_solver& solver) {
  TUNICA_CHECK(solver.problem != nullptr, "the solver has not been set up: " + solver.message);
  return *solver.problem;
}

}  // namespace

extern "C" {

tunica_solver* tunica_create(long long rows, const long long* offsets, const long long* columns,
                             const double* values, const char* settings, const int* communicator) {
  auto* const solver = new (std::nothrow) tunica_solver;
  if (solver == nullptr) return nullptr;
  guarded(solver, [&]() -> Ending {
    begin_session();
    solver->problem = std::make_unique<foreign::Problem>(
        foreign::OwnRows{rows, offsets, columns, values}, settings == nullptr ? "" : settings,
        ranks_of(communicator));
    return {TUNICA_SOLVED, ""};
  });
  return solver;
}

int tunica_refresh(tunica_solver* solver, const double* values) {
  return guarded(solver, [&]() -> Ending {
    const std::string reason = problem_of(*solver).refresh(values);
    solver->report.is_refresh_numeric = reason.empty() ? 1 : 0;
    return {TUNICA_SOLVED, reason.empty() ? "" : "all has been set up anew: " + reason};
  });
}

int tunica_solve(tunica_solver* solver, const double* b, double* x) {
  return guarded(solver, [&]() -> Ending {
    foreign::Problem& problem = problem_of(*solver);
    const foreign::Answer answer = problem.solve(b, x);
    solver->report.iterations = answer.report.iterations;
    solver->report.residual = problem.residual();
    solver->report.backward_error = answer.residuals.backward_error;
    return {answer.report.is_converged ? TUNICA_SOLVED : TUNICA_NOT_CONVERGED, answer.failures};
  });
}

const tunica_report* tunica_query(const tunica_solver* solver) {
  static const tunica_report none{TUNICA_FAULT,         0,  0,  0, 0, 0.0, 0.0, 0.0, 0.0, 0.0,
                                  "there is no solver", "", "", ""};
  return solver == nullptr ? &none : &solver->report;
}

void tunica_destroy(tunica_solver* solver) { delete solver; }

}  // extern "C"
