"""The page inside the test's process, without a browser: what a control does to the session."""

import asyncio
import gc
import weakref

import pytest

pytest.importorskip("nicegui", reason="nicegui is not installed (extra web)")

from nicegui import Client, ui
from nicegui.events import GenericEventArguments
from nicegui.testing.user_simulation import user_simulation

from antinode.app.page import Page
from antinode.app.source import read_example
from antinode.app.state import File, State
from app_browser import run_async


def visit(action, example="starter", complaint=""):
    """Open the page of an example and let an action use it."""

    async def main():
        pages = []

        def root():
            pages.append(
                Page(State(File(read_example(example).tables, f"{example}.toml")), complaint)
            )

        async with user_simulation(root=root) as user:
            await user.open("/")
            page = pages[0]
            page.session.again()
            await result(page, lambda s: s.answer and s.answer.full)
            await action(user, page)

    run_async(main())


async def result(page, wanted, most=60.0):
    """Wait until the session is as wanted."""
    for _ in range(int(most / 0.05)):
        if wanted(page.session):
            return
        await asyncio.sleep(0.05)
    raise AssertionError(f"the session did not get there: {page.session.error}")


def one(user, marker):
    """The element with a marker."""
    return next(iter(user.find(marker=marker).elements))


def test_a_slider_moves_the_case_and_its_field():
    async def act(user, page):
        one(user, "slider-condition.speed").value = 100.0
        await result(page, lambda s: s.answer.case.condition.speed == 100.0)
        assert one(user, "field-condition.speed").value == "100"
        user.find("Undo").click()
        await result(page, lambda s: s.answer.case.condition.speed == 80.0)
        assert one(user, "field-condition.speed").value == "80"
        assert one(user, "slider-condition.speed").value == 80.0

    visit(act)


def test_a_wrong_field_keeps_the_last_good_answer():
    async def act(user, page):
        before = page.session.answer
        user.find(marker="field-condition.thrust").clear().type("many").trigger("keydown.enter")
        await result(page, lambda s: s.error)
        assert "condition.thrust is 'many'; it needs a number" in page.session.error
        await user.should_see("condition.thrust is 'many'")
        assert page.session.answer is before

    visit(act)


def test_cavitation_number_gives_way_to_depth():
    async def act(user, page):
        one(user, "cavitation").value = "condition.depth"
        await result(page, lambda s: s.answer.case.condition.cavitation_number is None)
        await user.should_see("depth")
        assert page.session.answer.case.loads.sigma == pytest.approx(0.02, rel=1e-5)

    visit(act)


def test_a_beam_has_no_vehicle():
    async def act(user, page):
        await user.should_not_see("Vehicle in its cavity, to scale, with the forces on it")
        one(user, "switch-right").value = "pinned"
        await result(page, lambda s: s.answer.beam.ends.right == "pinned")

    visit(act, "tower")


def test_equipment_is_checked_and_kept():
    async def act(user, page):
        user.find(marker="from").type("18").trigger("keydown.enter")
        await user.should_see("one end is missing")
        user.find(marker="to").type("25").trigger("keydown.enter")
        await result(page, lambda s: s.state.view.band == (18.0, 25.0))

    visit(act)


def test_opening_an_example_can_be_undone():
    async def act(user, page):
        user.find(marker="example-drill_string").click()
        await result(page, lambda s: s.answer.case is None)
        user.find("Undo").click()
        await result(page, lambda s: s.answer.case is not None)
        await user.should_see("Vehicle in its cavity, to scale, with the forces on it")

    visit(act)


def test_a_complaint_about_the_link_is_shown():
    async def act(user, page):
        assert any("link is damaged" in text for text in user.notify.messages)

    visit(act, complaint="the link is damaged: check it")


def test_units_are_those_of_the_view():
    async def act(user, page):
        one(user, "units").value = "US"
        await result(page, lambda s: s.state.view.units == "US")
        await result(page, lambda _: one(user, "field-condition.speed").value == "262.467")
        assert isinstance(one(user, "field-condition.speed"), ui.input)

    visit(act)


def test_a_newer_change_ends_the_work_on_an_older_one():
    async def act(user, page):
        for speed in range(81, 99):
            page.session.change({"condition.speed": float(speed)}, moving="condition.speed")
            await asyncio.sleep(0.005)
        await result(page, lambda s: s.answer.case.condition.speed == 98.0 and s.answer.full)
        assert page.session.history.undo().problem.condition.speed == 80.0

    visit(act)


def test_a_page_that_is_closed_is_forgotten():
    """Neither its route for uploads nor a cache keeps it."""
    pages = []

    async def main():
        def root():
            pages.append(weakref.ref(Page(State(File(read_example("tower").tables, "t.toml")))))

        async with user_simulation(root=root) as user:
            for _ in range(4):
                await user.open("/")
                for client in list(Client.instances.values()):
                    if client is not user.client:
                        client.delete()
            await asyncio.sleep(0)
            gc.collect()
            assert [page() is not None for page in pages[:-1]] == [False] * 3

    run_async(main())


def test_rest_comes_after_all_that_was_asked_for():
    """Also after work whose end begins more work, as that of a file that is opened."""

    async def act(user, page):
        session = page.session
        session.change({"condition.speed": 90.0})
        await session.rest()
        assert session.answer.full
        assert session.answer.case.condition.speed == 90.0
        user.find(marker="example-tower").click()
        await asyncio.sleep(0)  # the click's own work has begun
        await session.rest()
        assert session.answer.case is None
        assert session.answer.full
        sent = []
        page._board.apply = sent.append
        await page._asked(GenericEventArguments(sender=page._board, client=user.client, args=7))
        assert sent == [{"answered": 7}]

    visit(act)
