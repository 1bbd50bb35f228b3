//! What visitors of the page do.

use crate::browser::Browser;
use crate::{cross, host, module, server, tools};
use anyhow::{Context, Result, ensure};
use kibiray_gallery::EXHIBITS;
use std::fs;
use std::path::PathBuf;

/// Pixels of the page's picture.
const SIZE: (u16, u16) = (640, 480);

/// `WebDriver`'s names of keys.
const LEFT: char = '\u{e012}';
const UP: char = '\u{e013}';
const HOME: char = '\u{e011}';
const TAB: char = '\u{e004}';

/// What these tests need.
pub(crate) struct Tools {
    module: module::Tools,
    chromium: PathBuf,
    driver: PathBuf,
}

impl Tools {
    pub(crate) fn find() -> Result<Self, String> {
        Ok(Self {
            chromium: tools::find("chromium")?,
            driver: tools::find("chromedriver")?,
            module: module::Tools::find()?,
        })
    }
}

/// What a visitor does.
type Visit = fn(&Browser) -> Result<()>;

pub(crate) static ALL: [(&str, Visit); 5] = [
    ("every_scene_is_the_hosts_picture", scenes),
    ("budget_changes_the_report_and_not_the_picture", budget),
    ("views_by_keys_mouse_and_touch", views),
    ("heat_map", heat),
    ("on_a_phone", phone),
];

/// Serves the page, opens it, and ends with a look at the console.
pub(crate) fn make(tools: &Tools, visit: Visit) -> Result<()> {
    let module = module::make(&tools.module, "wasm/page")?;
    let (_server, address) = server::serve(&module.built)?;
    let browser = Browser::start(&tools.driver, &tools.chromium, (1280, 960))?;
    browser.open(&address)?;
    visit(&browser)?;
    let console = browser.console()?;
    ensure!(console.is_empty(), "on the console: {console:#?}");
    Ok(())
}

/// Waits for the picture; gives its checksum.
fn done(browser: &Browser) -> Result<String> {
    browser.wait("document.body.dataset.state === 'done'")?;
    browser.text("document.querySelector('#crc').textContent")
}

/// Sets a control as a visitor would, and waits until the page has noticed.
fn set(browser: &Browser, id: &str, value: usize) -> Result<()> {
    browser.run(&format!(
        "document.body.dataset.state = 'asked';
         const control = document.querySelector('#{id}');
         control.value = {value};
         control.dispatchEvent(new Event('input', {{ bubbles: true }}));"
    ))?;
    browser.wait("document.body.dataset.state !== 'asked'")
}

fn screenshot(browser: &Browser, name: &str) -> Result<()> {
    let folder = cross::target_dir().with_file_name("page");
    fs::create_dir_all(&folder)?;
    browser.screenshot(&folder.join(name).with_extension("png"))
}

fn scenes(browser: &Browser) -> Result<()> {
    // The list is made by the module, once that is loaded.
    done(browser)?;
    let offered = browser.text("document.querySelector('#scene').options.length")?;
    ensure!(offered == EXHIBITS.len().to_string(), "{offered} scenes");
    for number in 0..EXHIBITS.len() {
        set(browser, "scene", number)?;
        let sum = done(browser)?;
        screenshot(browser, &format!("desktop-{number}"))?;
        let expected = host::render(number, None, SIZE)?;
        ensure!(sum == expected, "scene {number}: {sum} instead of {expected}");
    }
    Ok(())
}

fn budget(browser: &Browser) -> Result<()> {
    const SPONGE: usize = 2;
    let report =
        "document.querySelector('#parts').innerText + document.querySelector('#tests').innerText";
    set(browser, "scene", SPONGE)?;
    let (first, sum) = (browser.text(report)?, done(browser)?);
    set(browser, "ram", 40)?;
    let second = done(browser)?;
    ensure!(second == sum, "another budget, another picture: {sum}, {second}");
    let report_now = browser.text(report)?;
    ensure!(report_now != first, "another budget, the same report: {first}");

    // Grid and hierarchy.
    for structure in [2, 4] {
        set(browser, "structure", structure)?;
        let other = done(browser)?;
        ensure!(other == sum, "structure {structure}, another picture: {sum}, {other}");
    }

    // By the plan everything goes without memory; an octree does not.
    set(browser, "structure", 3)?;
    done(browser)?;
    set(browser, "ram", 0)?;
    browser.wait("document.body.dataset.state === 'refused'")?;
    let message = browser.text("document.querySelector('#message').innerText")?;
    screenshot(browser, "desktop-refused")?;
    let needed = host::octree_needs(SPONGE, 1024)?;
    let (thousands, rest) = (needed / 1000, needed % 1000);
    ensure!(message.contains("too small"), "{message}");
    ensure!(message.contains(&format!("{thousands},{rest:03} bytes")), "{needed}: {message}");
    // One press on the button, and all is well.
    browser.run("document.querySelector('#message-act').click()")?;
    browser.wait("document.querySelector('#message').hidden")?;
    // The picture would take long with so little; with more it is the same again.
    set(browser, "ram", 64)?;
    let third = done(browser)?;
    ensure!(third == sum, "an octree of a wish, another picture: {sum}, {third}");
    Ok(())
}

/// Checks the picture from where the eye is now, which must not be where it was.
fn from_here(browser: &Browser, before: &mut String) -> Result<()> {
    let eye = "document.querySelector('#canvas').dataset.eye";
    browser.wait(&format!("{eye} !== '{before}'"))?;
    let sum = done(browser)?;
    *before = browser.text(eye)?;
    // Read as doubles, which single precision was widened to: nothing is rounded.
    let numbers: Result<Vec<f64>, _> = before.split(' ').map(str::parse).collect();
    let numbers: Vec<f32> = numbers?.into_iter().map(|n| n as f32).collect();
    let place = <[f32; 3]>::try_from(numbers).ok().context("three numbers")?;
    let expected = host::render(0, Some(place), SIZE)?;
    ensure!(sum == expected, "from {before}: {sum} instead of {expected}");
    Ok(())
}

fn views(browser: &Browser) -> Result<()> {
    let first = done(browser)?;
    let mut eye = browser.text("document.querySelector('#canvas').dataset.eye")?;
    // The first thing that the keyboard comes to is the picture.
    browser.press(TAB)?;
    let focus = browser.text("document.activeElement.id")?;
    ensure!(focus == "canvas", "the focus is on {focus}");
    for key in [LEFT, UP, '+'] {
        browser.press(key)?;
        from_here(browser, &mut eye)?;
    }
    for by in ["mouse", "touch"] {
        browser.drag(by, (300, 300), (80, -30))?;
        from_here(browser, &mut eye)?;
    }
    browser.press('0')?;
    browser.wait(&format!("document.querySelector('#canvas').dataset.eye !== '{eye}'"))?;
    let again = done(browser)?;
    ensure!(again == first, "the first view again: {again} instead of {first}");
    // The slider by keys as well.
    browser.run("document.querySelector('#ram').focus()")?;
    browser.press(HOME)?;
    browser.wait("document.querySelector('#budget').textContent === '1 KiB'")?;
    done(browser).map(drop)
}

fn heat(browser: &Browser) -> Result<()> {
    let sum = done(browser)?;
    let pixels = "document.querySelector('#canvas').toDataURL()";
    let before = browser.text(pixels)?;
    browser.run("document.querySelector('#heat').click()")?;
    let heat = browser.text(pixels)?;
    ensure!(heat != before, "the heat map is the picture");
    let brightest = browser.text("document.querySelector('#brightest').textContent")?;
    ensure!(brightest.replace(',', "").parse::<u32>()? > 1, "brightest: {brightest}");
    screenshot(browser, "desktop-heat")?;
    browser.run("document.querySelector('#heat').click()")?;
    ensure!(browser.text(pixels)? == before, "the picture does not come back");
    ensure!(done(browser)? == sum, "looking at it changed the picture");
    Ok(())
}

fn phone(browser: &Browser) -> Result<()> {
    for (width, height) in [(360, 780), (390, 844)] {
        browser.be_phone(width, height)?;
        let wide = browser.text("document.documentElement.scrollWidth")?;
        ensure!(wide.parse::<u32>()? <= width, "{wide} pixels wide on {width}");
    }
    set(browser, "scene", 3)?;
    done(browser)?;
    screenshot(browser, "phone")?;
    browser.run("scrollTo(0, document.documentElement.scrollHeight)")?;
    screenshot(browser, "phone-below")?;
    // Fingers need room.
    let small = "[...document.querySelectorAll('button, select, .check, input[type=range]')]
        .filter((it) => it.offsetParent && it.getBoundingClientRect().height < 32).map((it) => it.id)";
    let small = browser.text(small)?;
    ensure!(small.is_empty(), "too small to touch: {small}");
    Ok(())
}
