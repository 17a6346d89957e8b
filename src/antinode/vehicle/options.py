"""Every choice that the equations leave open, by name, with its default.

The reasons stand in docs/theory/hydrodynamics.md and docs/theory/loads.md.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from antinode.beam.checks import ShearForm, Theory
from antinode.inputs.units import Frozen, Number


class Model(Frozen):
    """Options of the hydrodynamic and the load model (table `[model]` of a case)."""

    gravity_rise: Literal["paper", "buoyancy", "none"] = Field(
        default="paper",
        description="rise h_g of the cavity axis: eq. 10, momentum of the buoyancy, or none",
    )
    gravity_rise_length: Literal["half_cavity", "cavity", "cavitator", "body"] = Field(
        default="half_cavity",
        description="length that makes the dimensionless h_g of eq. 10 a length: half the cavity, "
        "the whole cavity, the cavitator's diameter, or the body",
    )
    gravity_rise_factor: Annotated[Number, Field(ge=0)] = Field(
        default=1.0, description="factor on h_g, whichever formula it comes from [-]"
    )
    distortion: Literal["paper", "none"] = Field(
        default="paper", description="distortion h_sigma by the cavitator's angle: eq. 13, or none"
    )
    distortion_factor: Annotated[Number, Field(ge=0)] = Field(
        default=1.0, description="factor on h_sigma [-]"
    )
    fin_immersion: Literal["radial", "tip_distance"] = Field(
        default="radial",
        description="h_f of eq. 14: length of the fin outside the cavity, or distance of its tip "
        "from the cavity wall",
    )
    fin_lift: Literal["plate", "none"] = Field(
        default="plate", description="lift of the fins: thin plate on the wetted area, or none"
    )
    planing: Literal["paper", "none"] = Field(
        default="paper", description="planing forces: eq. 16 and 17, or none"
    )
    planing_area: Literal["arc", "projected"] = Field(
        default="arc",
        description="wetted width of eq. 16: the arc of the body outside the cavity, or its chord, "
        "at most the body's diameter",
    )
    planing_position: Literal["centroid", "tail"] = Field(
        default="centroid",
        description="where the planing forces act: the centroid of the wetted area, or the tail",
    )
    planing_drag_factor: Annotated[Number, Field(ge=0)] = Field(
        default=1.0, description="factor on the planing drag F_PX of eq. 16 [-]"
    )
    planing_angle: Literal["wall", "axis", "attitude"] = Field(
        default="wall",
        description="alpha_p of eq. 16: slope between the axes plus that of the cavity wall, slope "
        "between the axes, or the body angle",
    )
    planing_direction_width: Annotated[Number, Field(ge=0)] = Field(
        default=0.01,
        description="offset in body radii at which the planing force reaches its full size; it "
        "passes linearly through zero between the two directions [-]",
    )
    axial_force: Literal["exact", "element_midpoint"] = Field(
        default="exact",
        description="N along the axis: exact, with steps at the forces, or constant between the "
        "stations as in eq. 22",
    )
    theory: Theory = Field(
        default="timoshenko",
        description="of the beam: timoshenko counts shear, kGA of the stations or EA/(4 + 3 nu) as "
        "of a thin tube of nu = 0.3, and the rotary inertia of hull or stations; euler_bernoulli "
        "leaves both out, and their effect is estimated",
    )
    shear_form: ShearForm = Field(
        default="haringx", description="how the axial force and shear meet, in timoshenko's theory"
    )
    end_force: Literal["follows_body", "fixed_direction"] = Field(
        default="follows_body",
        description="whether thrust and the cavitator's drag turn with tail and nose, as those of "
        "a fixed nozzle and of a disk do, or keep their direction in space",
    )
    thrust_follows: Annotated[Number, Field(ge=0, le=1)] | None = Field(
        default=None, description="share of the thrust that turns with the tail; by end_force"
    )
    cavitator_follows: Annotated[Number, Field(ge=0, le=1)] | None = Field(
        default=None,
        description="share of the cavitator's drag that turns with the nose; by end_force",
    )

    hydrodynamic_stiffness: Literal["none", "tangent"] = Field(
        default="none",
        description="what fins, planing tail and cavitator do as the body vibrates: nothing, or "
        "their forces linearised about the computed state, as springs, dashpots and terms that "
        "follow",
    )

    fin_added_mass: Literal["none", "plate", "plate_one_face"] = Field(
        default="none",
        description="water that moves sideways with the wetted fins: none, rho pi c^2/4 per span "
        "as of a plate in open water, or half of that, a cavity behind it",
    )
    planing_added_mass: Literal["none", "wedge"] = Field(
        default="none",
        description="water that moves sideways with the planing tail: none, or rho pi b^2/8 of "
        "each strip, b its wetted width; rho pi R^2 where it is wet all round",
    )

    @model_validator(mode="after")
    def _one_for_the_disk(self) -> Model:
        if self.hydrodynamic_stiffness == "tangent" and self.cavitator_follows is not None:
            raise ValueError(
                "cavitator_follows: received beside hydrodynamic_stiffness = 'tangent', whose "
                "slope of the disk's lift takes the place of that share; leave one of the two out"
            )
        return self

    @property
    def follow(self) -> tuple[float, float]:
        """Shares that turn with the body: of the cavitator's drag, of the thrust."""
        share = 1.0 if self.end_force == "follows_body" else 0.0
        given = self.cavitator_follows, self.thrust_follows
        nose, tail = (share if own is None else own for own in given)
        return nose, tail

    @property
    def water_answers(self) -> bool:
        """Whether the water's stiffness answers the body's motion: modes are complex then."""
        return self.hydrodynamic_stiffness != "none"

    @property
    def is_theory_stated(self) -> bool:
        """Whether the theory of the beam was named."""
        return "theory" in self.model_fields_set

    @property
    def is_end_force_stated(self) -> bool:
        """Whether anything was said of the end forces."""
        return bool({"end_force", "thrust_follows", "cavitator_follows"} & self.model_fields_set)
