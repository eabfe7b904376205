// A compiled program on a well-known solver: SUNDIALS CVODE (Adams, fixed-point iteration) with its
// root finding, cell by cell on one core.
//
//     c++ -O3 -march=native -o cvode_peer cvode_peer.cpp -lsundials_cvode -lsundials_nvecserial -lm
//     ./cvode_peer DIR RESULTS.csv
//
// DIR holds the cells.csv and record.csv of `topple chart --cells-only --out DIR`.

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_version.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace {

constexpr double gravity = 9.81;
constexpr double rest = 1e-4;
constexpr size_t most_switches = 8;

struct Cell {
    int number;
    bool recorded, moves_h, moves_v;
    double omega, a_h, a_v, dt, t_max, tilt, half_width, height, offset;
    double mu_h, mu_v, rho2, omega_h, omega_v, psi, xi_h, xi_v, u_y, v0, pulse_end;
};

using Record = std::vector<std::pair<double, double>>;

struct Problem {
    const Cell* cell;
    const Record* record;
    int side;  // 0 in full contact
};

struct Rates {
    double x_base, y_base, ddphi, ug, vg;
};

double arm(const Cell& c, int side) { return c.half_width + side * c.offset; }

double critical(const Cell& c, int side) { return std::atan2(arm(c, side), c.height); }

Rates accelerations(const Problem& problem, double t, const double* y) {
    const Cell& c = *problem.cell;
    Rates r{0, 0, 0, 0, 0};
    if (c.recorded) {
        const Record& record = *problem.record;
        const double x = t / c.dt;
        const size_t i = std::min(static_cast<size_t>(std::max(x, 0.0)), record.size() - 2);
        const double share = x - static_cast<double>(i);
        r.ug = record[i].first + share * (record[i + 1].first - record[i].first);
        r.vg = record[i].second + share * (record[i + 1].second - record[i].second);
    } else if (t < c.pulse_end) {
        const double wave = std::sin(c.omega * t);
        r.ug = c.a_h * wave;
        r.vg = c.a_v * wave;
    }
    double f_h = r.ug, f_v = r.vg + gravity;
    if (c.moves_h) {
        const double square = c.omega_h * c.omega_h;
        f_h = -(c.psi * square * y[0] + (1 - c.psi) * square * c.u_y * y[4] +
                2 * c.xi_h * c.omega_h * y[1]);
    }
    if (c.moves_v) {
        f_v = -(c.omega_v * c.omega_v * y[2] + 2 * c.xi_v * c.omega_v * y[3]);
    }
    if (problem.side != 0) {
        const double b = arm(c, problem.side), h = c.height, s = problem.side;
        const double sin = std::sin(y[5]), cos = std::cos(y[5]);
        const double p = h * cos + s * b * sin, q = s * b * cos - h * sin, w = y[6] * y[6];
        f_h += c.mu_h * q * w;
        f_v += c.mu_v * p * w;
        r.ddphi = (p * f_h - q * f_v) /
                  (c.rho2 + b * b + h * h - c.mu_h * p * p - c.mu_v * q * q);
        f_h += c.mu_h * p * r.ddphi;
        f_v -= c.mu_v * q * r.ddphi;
    }
    r.x_base = f_h;
    r.y_base = f_v;
    return r;
}

double lifts(const Cell& c, const Rates& r, int side) {
    return side * r.x_base - arm(c, side) / c.height * r.y_base;
}

int right_hand_side(realtype t, N_Vector vector, N_Vector rates, void* data) {
    const Problem& problem = *static_cast<Problem*>(data);
    const Cell& c = *problem.cell;
    const double* y = N_VGetArrayPointer(vector);
    double* k = N_VGetArrayPointer(rates);
    const Rates r = accelerations(problem, t, y);
    k[0] = y[1];
    k[1] = c.moves_h ? r.x_base - r.ug : 0.0;
    k[2] = y[3];
    k[3] = c.moves_v ? r.y_base - r.vg - gravity : 0.0;
    k[4] = 0.0;
    if (c.moves_h && c.u_y > 0) {
        const double loading = y[1] * y[4] > 0 ? 1.0 : 0.0;
        k[4] = y[1] / c.u_y * (1.0 - y[4] * y[4] * loading);
    }
    k[5] = y[6];
    k[6] = r.ddphi;
    return 0;
}

int guards(realtype t, N_Vector vector, realtype* g, void* data) {
    const Problem& problem = *static_cast<Problem*>(data);
    const Cell& c = *problem.cell;
    const double* y = N_VGetArrayPointer(vector);
    if (problem.side != 0) {
        g[0] = -problem.side * y[5];
        g[1] = problem.side * y[5] - critical(c, problem.side);
    } else {
        const Rates r = accelerations(problem, t, y);
        g[0] = lifts(c, r, 1);
        g[1] = lifts(c, r, -1);
    }
    return 0;
}

struct Solved {
    std::string outcome = "unresolved", switches;
    double zeta = 0;
    size_t count = 0;

    void note(const char* kind, double t, const double* y) {
        if (count++ >= most_switches) return;
        char text[320];
        std::snprintf(text, sizeof text, "%s%s %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g",
                      switches.empty() ? "" : ";", kind, t, y[0], y[1], y[2], y[3], y[4], y[5], y[6]);
        switches += text;
    }
};

Solved solve(const Cell& c, const Record& record, double tolerance, SUNContext context) {
    Solved solved;
    Problem problem{&c, &record, (c.tilt > 0) - (c.tilt < 0)};
    N_Vector vector = N_VNew_Serial(7, context);
    double* y = N_VGetArrayPointer(vector);
    std::fill(y, y + 7, 0.0);
    y[2] = c.v0;
    y[5] = c.tilt;
    double largest[2] = {std::max(c.tilt, 0.0), std::max(-c.tilt, 0.0)};
    bool lifted = problem.side != 0;
    void* memory = CVodeCreate(CV_ADAMS, context);
    CVodeInit(memory, right_hand_side, 0.0, vector);
    CVodeSStolerances(memory, tolerance, 0.01 * tolerance);
    SUNNonlinearSolver iteration = SUNNonlinSol_FixedPoint(vector, 0, context);
    CVodeSetNonlinearSolver(memory, iteration);
    CVodeSetUserData(memory, &problem);
    CVodeSetMaxStep(memory, 0.05);
    CVodeSetMaxNumSteps(memory, 10000000);
    CVodeRootInit(memory, 2, guards);
    int rising[2] = {1, 1};
    CVodeSetRootDirection(memory, rising);
    CVodeSetNoInactiveRootWarn(memory);
    double t = 0.0;
    const double stops[2] = {c.recorded ? c.t_max : std::min(c.pulse_end, c.t_max), c.t_max};
    bool overturned = false, failed = false;
    for (const double stop : stops) {
        bool fresh = true;
        while (t < stop && !overturned && !failed) {
            if (problem.side == 0) {
                const Rates r = accelerations(problem, t, y);
                const double left = lifts(c, r, 1), right = lifts(c, r, -1);
                if (std::max(left, right) > 0) {
                    problem.side = left >= right ? 1 : -1;
                    lifted = true;
                    fresh = true;
                    solved.note(problem.side > 0 ? "uplift_left" : "uplift_right", t, y);
                }
            }
            if (fresh) {
                CVodeReInit(memory, t, vector);
                CVodeSetStopTime(memory, stop);
                fresh = false;
            }
            const int flag = CVode(memory, stop, vector, &t, CV_ONE_STEP);
            if (flag < 0) {
                failed = true;
                break;
            }
            if (problem.side != 0) {
                double& peak = largest[problem.side > 0 ? 0 : 1];
                peak = std::max(peak, std::fabs(y[5]));
            }
            if (flag != CV_ROOT_RETURN) continue;
            int found[2];
            CVodeGetRootInfo(memory, found);
            fresh = true;
            if (problem.side == 0) {
                problem.side = found[0] != 0 ? 1 : -1;
                lifted = true;
                solved.note(problem.side > 0 ? "uplift_left" : "uplift_right", t, y);
            } else if (found[1] != 0) {
                solved.note("overturn", t, y);
                overturned = true;
            } else {
                const int side = -problem.side;
                const double b = arm(c, side), other = arm(c, -side);
                const double kappa_h = 1 - c.mu_h, kappa_v = 1 - c.mu_v, h2 = c.height * c.height;
                const double d = c.rho2 + h2 * kappa_h + b * b * kappa_v, dphi = y[6];
                const double width = 2 * c.half_width;
                y[1] -= width * b * c.height * c.mu_h * kappa_v / d * dphi;
                y[3] -= side * width * c.mu_v * (h2 * kappa_h + c.rho2) / d * dphi;
                y[6] = (c.rho2 + h2 * kappa_h - b * other * kappa_v) / d * dphi;
                y[5] = 0.0;
                problem.side = side;
                if (std::fabs(y[6]) < rest) {
                    problem.side = 0;
                    y[6] = 0.0;
                }
                const char* kind = problem.side == 0 ? "impact_rest"
                                   : side > 0        ? "impact_left"
                                                     : "impact_right";
                solved.note(kind, t, y);
            }
        }
    }
    if (overturned) {
        solved.outcome = problem.side > 0 ? "overturned_left" : "overturned_right";
        solved.zeta = 1.0;
    } else if (!failed) {
        solved.outcome = lifted ? "rocking" : "full_contact";
        solved.zeta = std::max(largest[0] / critical(c, 1), largest[1] / critical(c, -1));
    }
    SUNNonlinSolFree(iteration);
    CVodeFree(&memory);
    N_VDestroy(vector);
    return solved;
}

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> words;
    std::stringstream stream(line);
    for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
    return words;
}

Cell read_cell(const std::map<std::string, std::string>& row) {
    const auto number = [&](const char* name) { return std::stod(row.at(name)); };
    Cell c{};
    c.number = static_cast<int>(number("cell"));
    c.recorded = number("recorded") != 0;
    c.omega = number("omega");
    c.a_h = number("a_h");
    c.a_v = number("a_v");
    c.dt = number("dt");
    c.t_max = number("t_max");
    c.tilt = number("tilt");
    c.half_width = number("half_width");
    c.height = number("height");
    c.offset = number("offset");
    const double mass = number("mass"), mass_v = mass + number("plate_v");
    const double mass_h = mass_v + number("plate_h"), t_h = number("t_h"), t_v = number("t_v");
    c.moves_h = t_h > 0;
    c.moves_v = t_v > 0;
    c.mu_h = c.moves_h ? mass / mass_h : 0;
    c.mu_v = c.moves_v ? mass / mass_v : 0;
    c.rho2 = number("inertia") / mass;
    c.omega_h = c.moves_h ? 2 * M_PI / t_h : 0;
    c.omega_v = c.moves_v ? 2 * M_PI / t_v : 0;
    c.psi = number("psi");
    c.xi_h = number("xi_h");
    c.xi_v = number("xi_v");
    c.u_y = c.moves_h ? number("alpha_y") * std::fabs(c.a_h) / (c.omega_h * c.omega_h) : 0;
    c.v0 = c.moves_v ? -gravity / (c.omega_v * c.omega_v) : 0;
    c.pulse_end = c.recorded ? c.t_max : 2 * M_PI / c.omega;
    return c;
}

}  // namespace

int main(int count, char** words) {
    if (count != 3) {
        std::cerr << "give the directory of cells.csv, and the file for the results\n";
        return 2;
    }
    const std::string directory = words[1];
    std::ifstream cells_file(directory + "/cells.csv"), record_file(directory + "/record.csv");
    std::string line;
    std::getline(cells_file, line);
    const auto names = split(line);
    std::vector<std::pair<std::string, std::vector<Cell>>> scenes;
    while (std::getline(cells_file, line)) {
        const auto values = split(line);
        std::map<std::string, std::string> row;
        for (size_t i = 0; i < names.size(); i++) row[names[i]] = values[i];
        if (scenes.empty() || scenes.back().first != row["scene"]) scenes.push_back({row["scene"], {}});
        scenes.back().second.push_back(read_cell(row));
    }
    Record record;
    std::getline(record_file, line);
    while (std::getline(record_file, line)) {
        const auto values = split(line);
        record.push_back({std::stod(values[0]), std::stod(values[1])});
    }
    SUNContext context;
    SUNContext_Create(nullptr, &context);
    char version[32];
    SUNDIALSGetVersion(version, sizeof version);
    std::ofstream results(words[2]);
    results.precision(17);
    results << "scene,method,precision,step,tolerance,threads,seconds_a_cell,start_seconds,runs,cell,"
               "outcome,zeta,switches\n";
    for (const auto& [scene, cells] : scenes) {
        for (const double tolerance : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10}) {
            double seconds = INFINITY;
            std::vector<Solved> solved;
            for (int run = 0; run < 2; run++) {
                const auto began = std::chrono::steady_clock::now();
                solved.clear();
                for (const Cell& cell : cells) solved.push_back(solve(cell, record, tolerance, context));
                const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
                seconds = std::min(seconds, took.count() / static_cast<double>(cells.size()));
            }
            std::fprintf(stderr, "%-8s rtol %g: %.0f cells/s\n", scene.c_str(), tolerance, 1 / seconds);
            for (size_t i = 0; i < cells.size(); i++) {
                results << scene << ",CVODE " << version << ",f64,," << tolerance << ",1," << seconds
                        << ",0,2," << cells[i].number << ',' << solved[i].outcome << ','
                        << solved[i].zeta << ',' << solved[i].switches << '\n';
            }
        }
    }
    SUNContext_Free(&context);
}
