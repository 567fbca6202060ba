// SPDX-License-Identifier: BSD-3-Clause
// The few elements that panels are made of. Texts are set as text, never as markup.

type Child = Node | string | null;

/** An element with attributes and children. */
export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, string> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  for (const child of children) if (child !== null) element.append(child);
  return element;
}

let ids = 0;

/** An id that nothing else in the page has. */
export function newId(): string {
  ids++;
  return `control-${ids}`;
}

/** A titled group of controls. */
export function panel(title: string, ...children: Child[]): HTMLElement {
  const id = newId();
  return el(
    "section",
    { class: "panel", "aria-labelledby": id },
    el("h2", { id }, title),
    ...children,
  );
}

export interface SliderOptions {
  label: string;
  min: number;
  max: number;
  step: number | "any";
  /** Keys move it by this where the step is 'any'. */
  onInput: (value: number) => void;
  /** What is written beside the label. */
  format?: (value: number) => string;
}

export interface Slider {
  element: HTMLElement;
  input: HTMLInputElement;
  set: (value: number) => void;
}

/** A labelled slider with its value in words. */
export function slider(options: SliderOptions): Slider {
  const id = newId();
  const input = el("input", {
    id,
    type: "range",
    min: String(options.min),
    max: String(options.max),
    step: String(options.step),
  });
  const output = el("output", { for: id });
  const write = () => {
    output.textContent = options.format?.(input.valueAsNumber) ?? input.value;
    input.setAttribute("aria-valuetext", output.textContent);
  };
  input.addEventListener("input", () => {
    write();
    options.onInput(input.valueAsNumber);
  });
  return {
    element: el(
      "div",
      { class: "row slider" },
      el("label", { for: id }, options.label),
      output,
      input,
    ),
    input,
    set: (value) => {
      input.value = String(value);
      write();
    },
  };
}

export interface Toggle {
  element: HTMLElement;
  input: HTMLInputElement;
}

/** A labelled checkbox. */
export function checkbox(label: string, onChange: (on: boolean) => void): Toggle {
  const input = el("input", { type: "checkbox" });
  input.addEventListener("change", () => onChange(input.checked));
  return { element: el("label", { class: "check" }, input, label), input };
}

/** One of several, as a row of radio buttons. */
export function choice<T extends string>(
  legend: string,
  options: readonly { value: T; label: string }[],
  onChange: (value: T) => void,
): { element: HTMLElement; set: (value: T) => void } {
  const name = newId();
  const inputs = options.map(({ value }) => el("input", { type: "radio", name, value }));
  inputs.forEach((input, idx) => {
    input.addEventListener("change", () => onChange(options[idx]!.value));
  });
  const labels = options.map(({ label }, idx) =>
    el("label", {}, inputs[idx]!, el("span", {}, label)),
  );
  const element = el(
    "fieldset",
    { class: "choice" },
    el("legend", { class: "hidden" }, legend),
    ...labels,
  );
  return {
    element,
    set: (value) => {
      for (const input of inputs) input.checked = input.value === value;
    },
  };
}

/** A labelled field for a number. */
export function numberField(
  label: string,
  attributes: Record<string, string>,
  onChange: (value: number) => void,
): { element: HTMLElement; input: HTMLInputElement } {
  const input = el("input", { type: "number", ...attributes });
  input.addEventListener("change", () => {
    if (Number.isFinite(input.valueAsNumber)) onChange(input.valueAsNumber);
  });
  return { element: el("label", { class: "number" }, label, input), input };
}
