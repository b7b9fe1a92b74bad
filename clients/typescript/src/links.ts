/** The address of a link of the service at `base`, which has no slash at its end. The link may contain the prefix. */
export function linked(base: string, link: string): string {
  const { origin, pathname } = new URL(base);
  const prefix = pathname.replace(/\/$/, "");
  return link.startsWith(`${prefix}/`) ? origin + link : base + link;
}
